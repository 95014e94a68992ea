// Reads bags of ROS 2 that are SQLite files (.db3): every topic whose messages are CDR.
#pragma once

#include <string>
#include <string_view>

#include "ident/data/log_streams.h"

namespace ident {

/// Streams as of an MCAP file. Bags since ROS 2 Iron hold the definitions of their types; for older ones
/// those of the common packages are known here, and topics of other types are named in `damage`.
struct Rosbag2Format {
  static bool recognises(std::string_view first);
  static LogStreams read(std::string_view bytes, const std::string& file);
};

}  // namespace ident
