// Why does the simulator not fly like the drone: where the gap lies, which cause explains it, how far it
// closes.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/gap/verdict/verdict.h"
#include "ident/model/vehicle.h"
#include "ident/result/result.h"
#include "ident/result/shown.h"

namespace ident {

struct GapOptions {
  std::vector<std::string> exclude;  ///< causes that must not be tried
  int most_causes = 4;               ///< in the vehicle; how its sensor is mounted comes on top
  std::function<void(double, const std::string&)> progress;
  Shown shown = Shown::pictures;  ///< pictures beyond that are left out
};

struct Diagnosis {
  Result result;    ///< schema ident.gap/1
  Vehicle adopted;  ///< the vehicle with refitted constants and the causes found
  Judged verdict;
  GapClosed gap;  ///< half a second ahead; NaN where nothing was predicted
};

/// Throws DataError when the logs do not allow a diagnosis at all.
Diagnosis diagnose_gap(const Vehicle& vehicle, std::span<const FlightLog> logs,
                       const GapOptions& options = {});

}  // namespace ident
