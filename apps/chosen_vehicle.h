// The vehicle that a command works with: a file, a simulator's file, or that of the campaign.
#pragma once

#include "command.h"
#include "ident/model/vehicle.h"

namespace ident::app {

/// Adds `--vehicle` and `--params`.
void add_vehicle_options(CLI::App& cli, std::string& vehicle, std::string& params);

/// The vehicle of `--vehicle`, else of ident.yaml, with the parameters of `--params` laid over. Throws
/// UsageError where there is none.
Vehicle chosen_vehicle(const std::string& file, const std::string& params, Context& context);

}  // namespace ident::app
