// A diagnosis of logs whose controller went on between the commands that were logged.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ident/gap/verdict/verdict.h"
#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

/// The vehicle with as much left open of its motors, and of what acts about yaw, as commands that went on
/// between rows `interval` s apart leave open: held to what a bench found, a fit bends all else for it. What
/// is held, or of which nothing is known, stays so.
Vehicle with_open_motors(const Vehicle& vehicle, double interval);

/// What was left open of these does not count as known.
void doubt_open_motors(std::vector<Parameter>& parameters);

/// The constants of a result by that vehicle beside what was stated, and these not as known.
void doubt_open_motors(Result& result, const Vehicle& stated);

/// What it found, but of motors, and of what acts about yaw, as was stated.
Vehicle with_stated_motors(Vehicle found, const Vehicle& stated);

/// Whether one of the causes is of what a controller does between the commands that were logged, or of its
/// size. `found`: the constants, with the sizes of causes.
bool may_be_commands(const std::vector<std::string>& causes, std::span<const Parameter> found);

/// A verdict by that vehicle: causes that what was not logged passes for are not named.
/// `in_words`: of the verdict that is left.
using InWords = std::function<std::string(const Judged&)>;
Judged with_open_commands(Judged verdict, std::span<const Parameter> found, double interval,
                          const InWords& in_words);

}  // namespace ident
