// Walks over the messages of a ULog, and makes streams of what it finds.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "ident/core/error.h"
#include "ident/io/packed/damage.h"
#include "ident/io/packed/little_endian.h"
#include "ident/io/ulog/conventions.h"
#include "ident/io/ulog/format.h"
#include "ident/io/ulog/layout.h"
#include "ident/io/ulog/values.h"

namespace ident {
namespace {

using ulog::Layout;

constexpr std::string_view kMagic = "\x55\x4c\x6f\x67\x01\x12\x35";
constexpr std::string_view kSync = "\x2F\x73\x13\x20\x25\x0C\xBB\x12";
constexpr std::size_t kHeader = 16;        // bytes: magic, version, time of the start
constexpr std::size_t kMessageHeader = 3;  // bytes: u16 size, u8 type
constexpr std::size_t kLargestUnknown =
    10000;                             // bytes; pyulog takes a larger message of no known type as damage
constexpr double kMicrosecond = 1e-6;  // s

struct Topic {
  std::string name;
  Layout layout;
  std::vector<std::uint64_t> begins;  ///< of its records in the file
};

struct Message {
  char type = 0;
  std::string_view payload;
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file) : bytes_(bytes), damage_(out_.damage) {
    out_.file = file;
    out_.format = "ulog";
    if (bytes.size() < kHeader)
      throw InputError(file, 0, "", fmt::format("ends at byte {}, within the header", bytes.size()));
    start_ = last_ = load<std::uint64_t>(bytes.data() + 8);
  }

  LogStreams run() {
    read_definitions();
    for (const std::uint64_t offset : appended_) {
      read_data(std::min<std::size_t>(offset, bytes_.size()));
      if (offset >= at_) at_ = std::min<std::size_t>(offset, bytes_.size());
    }
    read_data(bytes_.size());
    make_streams();
    ulog::name_firmware(out_);
    damage_.close();
    return std::move(out_);
  }

 private:
  /// The message at `at_`; its payload is cut where the file ends.
  std::optional<Message> peek() const {
    if (bytes_.size() - at_ < kMessageHeader) return std::nullopt;
    const std::size_t size = load<std::uint16_t>(bytes_.data() + at_);
    return Message{bytes_[at_ + 2], bytes_.substr(at_ + kMessageHeader, size)};
  }
  bool is_cut() const {
    return bytes_.size() - at_ - kMessageHeader < load<std::uint16_t>(bytes_.data() + at_);
  }
  void pass(const Message& message) { at_ += kMessageHeader + message.payload.size(); }

  void read_definitions() {
    at_ = kHeader;
    while (const std::optional<Message> message = peek()) {
      if (is_cut()) {
        at_ = bytes_.size();
        damage_.add(at_, "the file ends within its definitions");
        return;
      }
      if (message->type == 'A' || message->type == 'L' || message->type == 'C') return;
      if (!define(*message)) {
        if (message->payload.empty() || message->type == 0) {
          ++at_;  // as pyulog does: no message has no bytes
          continue;
        }
        damage_.add(at_, fmt::format("a definition of type {:#04x} cannot be read",
                                     static_cast<unsigned char>(message->type)));
      }
      pass(*message);
    }
  }

  bool define(const Message& message) {
    switch (message.type) {
      case 'B':
        return take_flags(message.payload);
      case 'F': {
        std::optional<ulog::Definition> found = ulog::parse_definition(message.payload);
        if (found) definitions_[found->name] = std::move(found->members);
        return found.has_value();
      }
      case 'P':
        return take_parameter(message.payload, false);
      default:
        return take_info(message);
    }
  }

  bool take_flags(std::string_view payload) {
    if (payload.size() < 40) return false;
    for (std::size_t i = 0; i < 8; ++i) {
      const int flags = static_cast<unsigned char>(payload[8 + i]);
      if ((i == 0 ? flags & ~1 : flags) != 0)
        throw InputError(out_.file, 0, "",
                         fmt::format("is a ULog with features that are not known here (incompatible flags "
                                     "{:#04x} in byte {})",
                                     flags, i));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto offset = load<std::uint64_t>(payload.data() + 16 + 8 * i);
      if (offset != 0) appended_.push_back(offset);
    }
    return true;
  }

  /// Messages that may stand in both parts; false where this is none of them, or not of its form.
  bool take_info(const Message& message) {
    switch (message.type) {
      case 'I':
        if (const auto found = ulog::parse_key_value(message.payload)) out_.facts[found->key] = found->text;
        return true;
      case 'M':
        return true;  // long texts: performance counters, consoles
      case 'Q':
        return true;  // defaults of parameters, which say nothing of this flight
      default:
        return false;
    }
  }

  bool take_parameter(std::string_view payload, bool in_flight) {
    const auto found = ulog::parse_key_value(payload);
    if (!found || !found->number) return false;
    if (in_flight)
      out_.parameter_changes.push_back({seconds(last_), found->key, *found->number});
    else
      out_.parameters[found->key] = *found->number;
    return true;
  }

  double seconds(std::uint64_t count) const {
    return static_cast<double>(static_cast<std::int64_t>(count - start_)) * kMicrosecond;
  }

  void read_data(std::size_t until) {
    while (const std::optional<Message> message = peek()) {
      if (is_cut() && message->type != 0 && known(message->type)) return;  // the last one, not written whole
      if (at_ + kMessageHeader + message->payload.size() > until) return;
      if (known(message->type) && !message->payload.empty()) {
        if (!take(*message))
          damage_.add(at_, fmt::format("a message of type '{}' cannot be read", message->type));
        pass(*message);
      } else if (!recover(*message, until)) {
        return;
      }
    }
  }

  static bool known(char type) {
    return std::string_view("DSALCIMPQOR").find(type) != std::string_view::npos;
  }

  bool take(const Message& message) {
    switch (message.type) {
      case 'D':
        return take_record(message.payload);
      case 'A':
        return subscribe(message.payload);
      case 'P':
        return take_parameter(message.payload, true);
      case 'O':
        return take_dropout(message.payload);
      case 'I':
      case 'M':
      case 'Q':
        return take_info(message);
      default:
        return true;  // texts, synchronisation, the end of a subscription
    }
  }

  bool subscribe(std::string_view payload) {
    if (payload.size() < 4) return false;
    const auto instance = static_cast<unsigned char>(payload[0]);
    const std::string_view type = payload.substr(3);
    std::optional<Layout> layout = ulog::layout_of(type, definitions_);
    if (!layout) return false;
    const std::string name = fmt::format("{}:{}", type, instance);
    std::unique_ptr<Topic>& topic = topics_[name];
    if (!topic) topic = std::make_unique<Topic>(Topic{name, *layout, {}});
    if (topic->layout != *layout) return false;
    const std::size_t id = load<std::uint16_t>(payload.data() + 1);
    if (id >= subscribed_.size()) subscribed_.resize(id + 1, nullptr);
    subscribed_[id] = topic.get();
    return true;
  }

  bool take_record(std::string_view payload) {
    if (payload.size() < 2) return false;
    const std::size_t id = load<std::uint16_t>(payload.data());
    Topic* const topic = id < subscribed_.size() ? subscribed_[id] : nullptr;
    const std::size_t size = payload.size() - 2;
    if (topic == nullptr || size < topic->layout.least || size > topic->layout.most) return false;
    topic->begins.push_back(static_cast<std::uint64_t>(payload.data() + 2 - bytes_.data()));
    if (topic->layout.timestamp)
      last_ = std::max(last_, load<std::uint64_t>(payload.data() + 2 + *topic->layout.timestamp));
    return true;
  }

  bool take_dropout(std::string_view payload) {
    if (payload.size() < 2) return false;
    const double from = seconds(last_);
    out_.dropouts.push_back({from, from + 1e-3 * load<std::uint16_t>(payload.data())});
    return true;
  }

  /// No message that is known: goes on behind the next synchronisation bytes, where there are any. In a
  /// message that may be a new one these are looked for in its payload only. False at the end.
  bool recover(const Message& message, std::size_t until) {
    const bool damaged =
        message.type == 0 || message.payload.empty() || message.payload.size() > kLargestUnknown || is_cut();
    const std::size_t next = damaged ? at_ + 1 : at_ + kMessageHeader;
    const std::size_t end = damaged ? until : next + message.payload.size();
    const std::size_t sync =
        damaged && sync_gone_ ? std::string_view::npos : bytes_.substr(next, end - next).find(kSync);
    damage_.add(at_, damaged ? "damaged; read on from the next synchronisation bytes"
                             : fmt::format("a message of type {:#04x}, which is not known",
                                           static_cast<unsigned char>(message.type)));
    if (sync != std::string_view::npos) {
      at_ = next + sync + kSync.size();
      return true;
    }
    if (!damaged) {
      at_ = end;
      return true;
    }
    sync_gone_ = true;  // searched to the end: not again, or many damaged places would take for ever
    if (is_cut()) return false;
    return search_without_sync(until);
  }

  /// Without synchronisation bytes: byte by byte to where a known message is followed by another one.
  bool search_without_sync(std::size_t until) {
    for (++at_; at_ + kMessageHeader <= until; ++at_) {
      const std::optional<Message> message = peek();
      if (!message || !known(message->type) || message->payload.empty() || is_cut()) continue;
      const std::size_t next = at_ + kMessageHeader + message->payload.size();
      if (next == until || (next + kMessageHeader <= until && known(bytes_[next + 2]))) return true;
    }
    return false;
  }

  void make_streams() {
    for (auto& [name, topic] : topics_) {
      if (topic->begins.empty()) continue;
      LogStream stream;
      stream.name = name;
      stream.fields = unpack(bytes_, topic->begins, topic->layout.fields);
      topic.reset();
      set_clock(stream, ulog::clock_of(stream), start_, kMicrosecond);
      out_.streams.push_back(std::move(stream));
    }
  }

  std::string_view bytes_;
  LogStreams out_;
  DamageNotes damage_;
  std::size_t at_ = kHeader;
  std::uint64_t start_ = 0, last_ = 0;  // us
  bool sync_gone_ = false;
  std::vector<std::uint64_t> appended_;
  ulog::Definitions definitions_;
  std::map<std::string, std::unique_ptr<Topic>> topics_;
  std::vector<Topic*> subscribed_;  ///< by message id
};

}  // namespace

bool UlogFormat::recognises(std::string_view first) { return first.starts_with(kMagic); }

LogStreams UlogFormat::read(std::string_view bytes, const std::string& file) {
  return Reader(bytes, file).run();
}

}  // namespace ident
