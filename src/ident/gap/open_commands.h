// A diagnosis of logs whose controller went on between the commands that were logged.
#pragma once

#include "ident/gap/verdict.h"
#include "ident/model/vehicle.h"

namespace ident {

/// The vehicle with as much left open of its motors, and of what acts about yaw, as commands that went on
/// between rows `interval` s apart leave open: held to what a bench found, a fit bends all else for it.
Vehicle with_open_motors(const Vehicle& vehicle, double interval);

/// A verdict by that vehicle: causes that what was not logged passes for are not named.
Judged with_open_commands(Judged verdict, double interval);

}  // namespace ident
