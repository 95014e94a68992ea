// Reads message definitions written as `.msg` text.
#pragma once

#include "ident/io/ros2/definition.h"

namespace ident::ros2 {

/// `geometry_msgs/msg/Pose` and `geometry_msgs::msg::Pose` as `geometry_msgs/Pose`.
std::string plain_type_name(std::string_view name);

/// Text of the encoding `ros2msg`: the type's own `.msg`, then those it needs, each behind a line of `=` and
/// `MSG: name`.
ParsedDefinitions parse_msg_text(std::string_view type, std::string_view text);

}  // namespace ident::ros2
