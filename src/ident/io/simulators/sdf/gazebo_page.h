// A whole new SDF model with a base link, rotor links, joints and motor plugins.
#pragma once

#include "ident/io/simulators/sdf/gazebo_motors.h"

namespace ident {

std::string gazebo_page(const Vehicle& vehicle, const Values& values, const GazeboDialect& dialect);

}  // namespace ident
