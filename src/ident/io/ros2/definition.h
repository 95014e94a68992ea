// What a ROS 2 message type consists of, whichever language it is written in.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ident::ros2 {

enum class Type : std::uint8_t {
  boolean,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  string,
  wstring,
  nested,
};

enum class Repeat : std::uint8_t { once, array, sequence };

struct MessageField {
  std::string name;
  Type type = Type::uint8;
  std::string nested;  ///< `geometry_msgs/Pose` where the type is a message
  Repeat repeat = Repeat::once;
  std::uint32_t count = 1;  ///< elements of an array
};

/// Fields of each type, by its name without `msg`: `geometry_msgs/Pose`.
using Definitions = std::map<std::string, std::vector<MessageField>, std::less<>>;

/// Types, or the reason why a text does not define them.
struct ParsedDefinitions {
  Definitions types;
  std::string problem;
};

}  // namespace ident::ros2
