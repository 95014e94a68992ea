// The parts of an MJCF file that make a multirotor: the free body, its sites and the actuators on them.
#pragma once

#include <Eigen/Core>
#include <string>

#include "ident/io/simulators/fields.h"

namespace ident {

/// Fields "mass", "inertial.pos", "diaginertia" or "fullinertia", "inertial.quat", "gravity", and for each
/// actuator at a site "rotorN.pos", "rotorN.zaxis" or "rotorN.quat", "rotorN.gear", "rotorN.ctrlrange",
/// "rotorN.dynprm". Attributes of default classes count. Throws InputError.
Fields mjcf_fields(const std::string& text, const std::string& file);

/// Inertia about the centre of gravity in the file's frame.
Eigen::Matrix3d mjcf_inertia(const Fields& fields);

/// Thrust axis of the site whose fields begin with `prefix`.
Eigen::Vector3d mjcf_axis(const Fields& fields, const std::string& prefix);

/// A text for comments and attributes of XML, without what would end one.
std::string xml_text(const std::string& name);

}  // namespace ident
