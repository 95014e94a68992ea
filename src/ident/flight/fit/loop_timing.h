// When in a controller's loop a command reaches the motors.
#pragma once

#include <span>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/flight/fit/fit.h"
#include "ident/flight/smoother/parameterisation.h"

namespace ident {

/// Longest loop of the controllers, s, where all logs state it and hold each command; else 0.
double loop_of(std::span<const FlightLog> logs);

/// Whether one of the logs states that its controller makes more commands than it holds.
bool commands_are_skipped(std::span<const FlightLog> logs);

/// Where logs state the loop of their controller and hold each of its commands, the stamp of a command says
/// when it reached the motors to about a loop. The dead time is free then, about what was stated, known to
/// one loop beside its own deviation. `p`: constants at the start.
void leave_loop_open(std::vector<FreeConstant>& constants, const Vehicle& vehicle,
                     const std::vector<double>& p, std::span<const FlightLog> logs);

/// By how much the shape of the motors' answer is open there, as a step of the unknowns: samples of rates and
/// of rotor speeds may be means over the time between them (gyros that integrate, telemetry), T, which looks
/// like an answer that is wider by T^2/12. At the same lag 2 zeta_m/omega_m that makes omega_m and zeta_m
/// larger or smaller by the share omega_m^2 T^2/48. Zero where no loop is stated.
Eigen::VectorXd moved_by_smoothing(std::span<const FlightLog> logs, const Theta& theta, const FlightFit& fit);

}  // namespace ident
