// Reads MCAP files of ROS 2 (rosbag2, mcap recorders): every topic whose messages are CDR.
#include "ident/io/mcap/format.h"

#include <fmt/format.h>

#include <map>
#include <vector>

#include "ident/core/error.h"
#include "ident/io/mcap/decompress.h"
#include "ident/io/mcap/records.h"
#include "ident/io/packed/crc32.h"
#include "ident/io/packed/damage.h"
#include "ident/io/ros2/idl_text.h"
#include "ident/io/ros2/msg_text.h"
#include "ident/io/ros2/topic.h"

namespace ident {

namespace {

using namespace mcap;

constexpr std::string_view magic = "\x89MCAP0\r\n";

struct Schema {
  std::string name;
  std::string encoding;
  std::string text;
};

class McapReader {
 public:
  explicit McapReader(LogStreams& streams) : streams_(streams), damage_(streams.damage) {}

  void read(Bytes bytes) {
    std::size_t at = magic.size();
    while (const auto record = record_at(bytes, at)) {
      if (record->op == Op::data_end || record->op == Op::footer) {
        closed_ = true;
        break;
      }
      if (!record->whole) damage_.add(at, "the file ends within a record");
      if (record->op == Op::chunk)
        read_chunk(*record, at);
      else if (record->whole)
        read_record(*record, at);
      at = record->end;
    }
    if (!closed_) damage_.add(at, "the file was not closed");
    damage_.close();
    for (const auto& [topic, why] : not_read_)
      streams_.damage.push_back(fmt::format("topic {} is not read: {}", topic, why));
    ros2::add_topics(topics_, streams_);
  }

 private:
  void read_record(const Record& record, std::size_t at) {
    RecordReader in(record.content);
    switch (record.op) {
      case Op::schema:
        read_schema(in);
        break;
      case Op::channel:
        read_channel(in);
        break;
      case Op::message:
        read_message(in, at);
        break;
      case Op::metadata:
        read_metadata(in);
        break;
      case Op::header:
        streams_.facts["profile"] = std::string(in.string());
        streams_.facts["library"] = std::string(in.string());
        break;
      default:
        break;
    }
    if (!in.ok()) damage_.add(at, "a record is shorter than its fields");
  }

  void read_chunk(const Record& record, std::size_t at) {
    RecordReader in(record.content);
    in.number<std::uint64_t>();  // times of its first and last message
    in.number<std::uint64_t>();
    const auto size = in.number<std::uint64_t>();
    const auto checksum = in.number<std::uint32_t>();
    const std::string_view compression = in.string();
    const auto packed_size = in.number<std::uint64_t>();
    if (!in.ok()) return damage_.add(at, "a chunk is shorter than its head");
    const Bytes packed = in.rest().first(std::min<std::uint64_t>(packed_size, in.rest().size()));
    if (compression.empty()) return read_records(packed, at, record.whole ? checksum : 0);
    const Unpacked unpacked = decompress(compression, packed, size);
    if (!unpacked.problem.empty() && record.whole)
      damage_.add(at, "a chunk cannot be unpacked: " + unpacked.problem);
    read_records(unpacked.bytes, at, unpacked.problem.empty() && record.whole ? checksum : 0);
  }

  /// Records of a chunk. One that does not have its checksum (0: none was made) is left out.
  void read_records(Bytes records, std::size_t chunk, std::uint32_t checksum) {
    if (checksum != 0 && crc32({reinterpret_cast<const char*>(records.data()), records.size()}) != checksum)
      return damage_.add(chunk, "a chunk does not have its checksum and is left out");
    std::size_t at = 0;
    while (const auto record = record_at(records, at)) {
      if (record->whole && record->op != Op::chunk) read_record(*record, chunk);
      at = record->end;
    }
  }

  void read_schema(RecordReader& in) {
    const auto id = in.number<std::uint16_t>();
    const std::string_view name = in.string();
    const std::string_view encoding = in.string();
    const std::string_view text = in.string();
    if (in.ok()) schemas_[id] = {std::string(name), std::string(encoding), std::string(text)};
  }

  void read_channel(RecordReader& in) {
    const auto id = in.number<std::uint16_t>();
    const auto schema_id = in.number<std::uint16_t>();
    const std::string topic(in.string());
    const std::string_view encoding = in.string();
    if (!in.ok() || channels_.count(id) > 0) return;
    channels_[id] = no_topic;
    const auto schema = schemas_.find(schema_id);
    if (schema == schemas_.end()) {
      not_read_[topic] = "its type is not described";
    } else if (encoding != "cdr") {
      not_read_[topic] = fmt::format("its messages are encoded as {}", encoding);
    } else {
      channels_[id] = topic_of(topic, schema_id, schema->second);
    }
  }

  /// Place of a topic. A topic that was opened again with the same schema is one stream.
  std::size_t topic_of(const std::string& topic, std::uint16_t schema_id, const Schema& schema) {
    const auto known = topic_places_.find({topic, schema_id});
    if (known != topic_places_.end()) return known->second;
    ros2::ParsedDefinitions parsed;
    if (schema.encoding == "ros2msg")
      parsed = ros2::parse_msg_text(schema.name, schema.text);
    else if (schema.encoding == "ros2idl")
      parsed = ros2::parse_idl_text(schema.text);
    else
      parsed.problem = fmt::format("its type is described as {}", schema.encoding);
    if (!parsed.problem.empty()) {
      not_read_[topic] = parsed.problem;
      return no_topic;
    }
    std::string name = topic;
    for (int again = 2; names_.count(name) > 0; ++again) name = fmt::format("{}#{}", topic, again);
    names_[name] = topics_.size();
    topics_.emplace_back(name, schema.name, std::move(parsed.types));
    topic_places_[{topic, schema_id}] = topics_.size() - 1;
    return topics_.size() - 1;
  }

  void read_message(RecordReader& in, std::size_t at) {
    const auto channel = in.number<std::uint16_t>();
    in.number<std::uint32_t>();  // sequence
    const auto log_time = in.number<std::uint64_t>();
    in.number<std::uint64_t>();  // time of publishing
    if (!in.ok()) return;
    if (last_place_ == no_topic || channel != last_channel_) {
      const auto place = channels_.find(channel);
      if (place == channels_.end())
        return damage_.add(at, fmt::format("a message of channel {}, which is not described", channel));
      last_channel_ = channel;
      last_place_ = place->second;
    }
    if (last_place_ != no_topic) topics_[last_place_].add(static_cast<std::int64_t>(log_time), in.rest());
  }

  void read_metadata(RecordReader& in) {
    const std::string name(in.string());
    RecordReader pairs(in.take(in.number<std::uint32_t>()));
    while (pairs.ok() && !pairs.rest().empty()) {
      const std::string key(pairs.string());
      const std::string value(pairs.string());
      if (pairs.ok()) streams_.facts[name + "." + key] = value;
    }
  }

  static constexpr std::size_t no_topic = static_cast<std::size_t>(-1);

  LogStreams& streams_;
  DamageNotes damage_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, std::size_t> channels_;
  std::map<std::pair<std::string, std::uint16_t>, std::size_t> topic_places_;
  std::map<std::string, std::size_t> names_;
  std::vector<ros2::Topic> topics_;
  std::map<std::string, std::string> not_read_;
  std::uint16_t last_channel_ = 0;
  std::size_t last_place_ = no_topic;
  bool closed_ = false;
};

}  // namespace

bool McapFormat::recognises(std::string_view first) { return first.starts_with(magic); }

LogStreams McapFormat::read(std::string_view text, const std::string& file) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  LogStreams streams{.file = file, .format = "mcap"};
  if (!recognises(text)) throw InputError(file, 0, "", "does not begin as an MCAP file does");
  McapReader(streams).read(bytes);
  if (streams.streams.empty())
    throw InputError(file, 0, "",
                     streams.damage.empty() ? std::string("holds no messages")
                                            : "no topic of it can be read: " + streams.damage.front());
  return streams;
}

}  // namespace ident
