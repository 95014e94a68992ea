// Reads message definitions written as OMG IDL, the part of it that ROS 2 generates.
#pragma once

#include "ident/io/ros2/definition.h"

namespace ident::ros2 {

/// Text of the encoding `ros2idl`: modules with structures, each file behind a line of `=` and `IDL: name`.
ParsedDefinitions parse_idl_text(std::string_view text);

}  // namespace ident::ros2
