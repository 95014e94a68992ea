// Reads MCAP files of ROS 2 (rosbag2, mcap recorders): every topic whose messages are CDR.
#pragma once

#include <string>
#include <string_view>

#include "ident/data/log_streams.h"

namespace ident {

/// One stream a topic, named as the topic; fields as in ros2/message_columns.h, times as in ros2/topic.h.
/// Schemas are read from the encodings ros2msg and ros2idl; topics in others (protobuf, JSON, ...) are named
/// in `damage`. Metadata records and the first text of each text field become facts.
struct McapFormat {
  static bool recognises(std::string_view first);
  static LogStreams read(std::string_view bytes, const std::string& file);
};

}  // namespace ident
