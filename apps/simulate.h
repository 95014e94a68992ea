// The kinds of data that `ident simulate` makes, one subcommand each.
#pragma once

#include "command.h"

namespace ident::app {

/// Declares `simulate flight`; `chosen` is set when it is what was asked for.
void add_simulate_flight(CLI::App& cli, const std::shared_ptr<Action>& chosen);

/// The sentence at the top of a simulated file: command and seed.
std::vector<std::string> provenance(const std::string& what, const std::string& vehicle, std::uint64_t seed);

}  // namespace ident::app
