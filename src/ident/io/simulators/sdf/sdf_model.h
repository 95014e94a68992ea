// The parts of an SDF model that make a multirotor for Gazebo's motor plugins: links with mass, and rotors.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "ident/io/simulators/fields.h"
#include "ident/io/simulators/reduced.h"

namespace ident {

/// Number of rotors, by their links.
std::size_t sdf_rotors(const Fields& fields);

/// Hub and thrust axis of a rotor in the frame of the base link (forward, left, up).
Eigen::Vector3d sdf_hub(const Fields& fields, std::size_t rotor);
Eigen::Vector3d sdf_axis(const Fields& fields, std::size_t rotor);

/// Mass, centre and inertia about it of all links together, or of all but the base, in the frame of the base
/// link. `hubs` replaces the places of the rotors.
MassProperties sdf_body(const Fields& fields, bool with_base, const std::vector<Eigen::Vector3d>& hubs = {});

/// The base link that makes `whole` together with the `rest`. Throws InputError where no body could be so.
MassProperties sdf_base(const Fields& fields, const MassProperties& whole, const MassProperties& rest);

/// Roll, pitch and yaw of the turn that takes z into an axis.
Eigen::Vector3d roll_pitch_to(const Eigen::Vector3d& axis);

}  // namespace ident
