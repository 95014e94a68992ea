// Message types of the common ROS 2 packages, whose fields have been the same since they were first released.
#pragma once

#include "ident/io/ros2/definition.h"

namespace ident::ros2 {

/// Types of the common packages (std_msgs, geometry_msgs, sensor_msgs, nav_msgs, mavros_msgs, ...), for bags
/// that do not hold their own definitions.
const Definitions& common_definitions();

}  // namespace ident::ros2
