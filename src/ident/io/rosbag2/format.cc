// Reads bags of ROS 2 that are SQLite files (.db3): every topic whose messages are CDR.
#include "ident/io/rosbag2/format.h"

#include <fmt/format.h>

#include <map>
#include <vector>

#include "ident/core/error.h"
#include "ident/io/ros2/common_definitions.h"
#include "ident/io/ros2/idl_text.h"
#include "ident/io/ros2/msg_text.h"
#include "ident/io/ros2/topic.h"
#include "ident/io/rosbag2/database.h"

namespace ident {

namespace {

using rosbag2::Database;
using rosbag2::Rows;

constexpr std::string_view magic("SQLite format 3\0", 16);

/// Definitions of a type: the bag's own, else those of the common packages.
ros2::ParsedDefinitions definitions_of(
    const std::string& type, const std::map<std::string, std::pair<std::string, std::string>>& stored) {
  const auto own = stored.find(type);
  if (own == stored.end() || own->second.second.empty()) {
    if (ros2::common_definitions().count(ros2::plain_type_name(type)) > 0)
      return {ros2::common_definitions(), {}};
    return {{},
            "the bag does not define its type (bags before ROS 2 Iron do not); `ros2 bag convert` to mcap "
            "where the package is installed"};
  }
  const auto& [encoding, text] = own->second;
  if (encoding == "ros2msg") return ros2::parse_msg_text(type, text);
  if (encoding == "ros2idl") return ros2::parse_idl_text(text);
  return {{}, fmt::format("its type is described as {}", encoding)};
}

class BagReader {
 public:
  BagReader(std::string_view bytes, LogStreams& streams) : database_(bytes), streams_(streams) {}

  /// False where the database is none of a bag.
  bool read() {
    if (!database_.has_table("topics") || !database_.has_table("messages")) return false;
    read_definitions();
    read_topics();
    read_messages();
    if (const std::string problem = database_.problem(); !problem.empty()) streams_.damage.push_back(problem);
    ros2::add_topics(topics_, streams_);
    return true;
  }
  std::string problem() const { return database_.problem(); }

 private:
  void read_definitions() {
    if (!database_.has_table("message_definitions")) return;
    Rows rows =
        database_.query("SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
    while (rows.next()) stored_[rows.text(0)] = {rows.text(1), rows.text(2)};
  }

  void read_topics() {
    Rows rows = database_.query("SELECT id, name, type, serialization_format FROM topics");
    while (rows.next()) {
      const std::string name = rows.text(1);
      const std::string type = rows.text(2);
      ros2::ParsedDefinitions definitions;
      if (const std::string format = rows.text(3); format == "cdr")
        definitions = definitions_of(type, stored_);
      else
        definitions.problem = fmt::format("its messages are encoded as {}", format);
      if (!definitions.problem.empty()) {
        streams_.damage.push_back(
            fmt::format("topic {} ({}) is not read: {}", name, type, definitions.problem));
        continue;
      }
      places_[rows.integer(0)] = topics_.size();
      topics_.emplace_back(name, type, std::move(definitions.types));
    }
  }

  /// In the order in which they were stored, which is that of their times but for some of the same moment.
  void read_messages() {
    Rows rows = database_.query("SELECT topic_id, timestamp, data FROM messages");
    while (rows.next())
      if (const auto place = places_.find(rows.integer(0)); place != places_.end())
        topics_[place->second].add(rows.integer(1), rows.blob(2));
  }

  Database database_;
  LogStreams& streams_;
  std::map<std::string, std::pair<std::string, std::string>> stored_;  ///< encoding and text by type
  std::map<std::int64_t, std::size_t> places_;
  std::vector<ros2::Topic> topics_;
};

}  // namespace

bool Rosbag2Format::recognises(std::string_view first) { return first.starts_with(magic); }

LogStreams Rosbag2Format::read(std::string_view bytes, const std::string& file) {
  LogStreams streams{.file = file, .format = "rosbag2"};
  BagReader reader(bytes, streams);
  if (!reader.read()) {
    const std::string problem = reader.problem();
    throw InputError(
        file, 0, "",
        "is an SQLite file without the tables of a ROS 2 bag" + (problem.empty() ? problem : ": " + problem));
  }
  if (streams.streams.empty())
    throw InputError(file, 0, "",
                     streams.damage.empty() ? std::string("holds no messages")
                                            : "no topic of it can be read: " + streams.damage.front());
  return streams;
}

}  // namespace ident
