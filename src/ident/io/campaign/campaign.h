// The files of one vehicle, from `ident.yaml` in a folder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

/// A log and the map to read it with (empty: none), and the same of a recording of motion capture.
struct CampaignLog {
  std::string file, map, motion = {}, motion_map = {};
};

/// The keys of `ident.yaml`; every file is relative to the folder of `ident.yaml`, paths here are ready to
/// open:
///
///   vehicle: falcon.yaml                 # vehicle file (required)
///   parameters: falcon-parameters.yaml   # where estimates are stored; default parameters.yaml
///   thrust: [sweep1.csv, sweep2.csv]     # bench files: one name or a list
///   motor: steps.csv
///   inertia: pendulum.csv
///   air: calm                            # how much it moves, in place of what the vehicle file states
///   map: crazyflie.yaml                  # map of all logs that name no other
///   logs:                                # names, or a name with a map of its own
///     - hover.csv
///     - {file: dash.csv, map: other.yaml}
///     - {file: loops.bbl, motion: loops.mcap, motion_map: capture.yaml}
struct Campaign {
  std::string file;  ///< ident.yaml itself
  std::string vehicle;
  std::string parameters;  ///< need not exist yet
  std::optional<AirLevel> air;
  std::vector<std::string> thrust, motor, inertia;
  std::vector<CampaignLog> logs;
};

/// The campaign of a folder; throws InputError when there is none or it is wrong.
Campaign read_campaign(const std::string& folder = ".");

/// The same, or nothing where the folder has no `ident.yaml`.
std::optional<Campaign> find_campaign(const std::string& folder = ".");

/// The vehicle file with the stored estimates laid over it, or with those `found`.
Vehicle campaign_vehicle(const Campaign& campaign);
Vehicle campaign_vehicle(const Campaign& campaign, const Vehicle& found);

/// New content of the parameter file: what it held, and what the result determines. For Context::outputs.
std::string updated_parameters(const Campaign& campaign, const Result& result);

}  // namespace ident
