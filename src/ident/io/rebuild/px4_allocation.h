// PX4's control allocation: from setpoints of torque and thrust to the commands of motors.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "ident/data/log_streams.h"

namespace ident {

/// u = mix (roll, pitch, yaw, thrust x, y, z), all normalised, where no motor saturates.
///   B_i = (CT (r_i x a_i) - CT KM a_i ; CT a_i) ,   mix = pinv(B), its columns scaled:
///   roll and pitch by max over both of sqrt(sum mix^2/(n/2)), n motors that act; yaw by its largest entry;
///   each thrust by the mean |mix| of the motors that act
/// [PX4 1.13 to 1.17, ControlAllocationPseudoInverse.cpp and ActuatorEffectivenessRotors.cpp]. Empty where
/// the log states no rotors (CA_ROTOR*, from 1.13 on).
std::optional<Eigen::MatrixXd> px4_mix(const LogStreams& log);

/// Command of an output for the thrust that the allocation asks for: u of (1 - f) u + f u^2 = thrust, with f
/// = THR_MDL_FAC [PX4, FunctionMotors.hpp]. The topic actuator_motors holds the thrust.
double px4_command(double thrust, double f);

}  // namespace ident
