// Reads card logs: events described at the begin, then records one behind the other, then a check sum.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "ident/core/error.h"
#include "ident/io/crazyflie/format.h"
#include "ident/io/packed/crc32.h"
#include "ident/io/packed/damage.h"
#include "ident/io/packed/little_endian.h"
#include "ident/io/packed/records.h"

namespace ident {
namespace {

constexpr char kMagic = '\xBC';
constexpr std::size_t kCheckSum = 4;  // bytes at the end
constexpr std::size_t kEventId = 2;   // bytes before each record

/// Letters of Python's struct module, with which variables state their type.
std::optional<PackedType> type_of(char letter) {
  constexpr std::string_view kLetters = "bBhHiIqQefd";
  constexpr std::array<PackedType, 11> kTypes = {
      PackedType::i8,  PackedType::u8,  PackedType::i16, PackedType::u16, PackedType::i32, PackedType::u32,
      PackedType::i64, PackedType::u64, PackedType::f16, PackedType::f32, PackedType::f64};
  const std::size_t at = kLetters.find(letter == '?' ? 'B' : letter);
  return at == std::string_view::npos ? std::nullopt : std::optional(kTypes[at]);
}

struct Event {
  std::string name;
  std::vector<PackedField> fields;
  std::size_t size = 0;               ///< bytes of a record behind its id
  std::vector<std::uint64_t> begins;  ///< of its records, behind their ids
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file) : bytes_(bytes), damage_(out_.damage) {
    out_.file = file;
    out_.format = "crazyflie";
  }

  LogStreams run() {
    read_events();
    read_records();
    for (const Event& event : events_) make_stream(event);
    damage_.close();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(out_.file, 0, "", fmt::format("byte {}: {}", at_, what));
  }

  template <class Number>
  Number take() {
    if (bytes_.size() - at_ < sizeof(Number)) fail("the file ends within its description of events");
    at_ += sizeof(Number);
    return load<Number>(bytes_.data() + at_ - sizeof(Number));
  }

  std::string_view take_text() {
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string_view::npos) fail("the file ends within its description of events");
    const std::string_view text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }

  void read_events() {
    at_ = 1;
    version_ = take<std::uint16_t>();
    out_.facts["version"] = fmt::format("{}", version_);
    const int count = take<std::uint16_t>();
    for (int i = 0; i < count; ++i) {
      const auto id = take<std::uint16_t>();
      if (!event_of_.emplace(id, events_.size()).second) fail(fmt::format("event {} is described twice", id));
      events_.push_back(read_event());
    }
  }

  Event read_event() {
    Event event;
    event.name = take_text();
    const bool is_long = version_ == 2;
    event.fields.push_back({.name = "time [s]",
                            .type = is_long ? PackedType::u64 : PackedType::u32,
                            .offset = 0,
                            .unit = "s",
                            .scale = is_long ? 1e-6 : 1e-3});
    event.size = size_of(event.fields.front().type);
    const int variables = take<std::uint16_t>();
    for (int i = 0; i < variables; ++i) {
      const std::string_view text = take_text();
      const std::size_t open = text.rfind('(');
      const bool typed = open != std::string_view::npos && open + 3 == text.size() && text.back() == ')';
      const std::optional<PackedType> type = typed ? type_of(text[open + 1]) : std::nullopt;
      if (!type) fail(fmt::format("variable '{}' states no type that is known", text));
      event.fields.push_back(
          {.name = std::string(text.substr(0, open)), .type = *type, .offset = event.size, .unit = ""});
      event.size += size_of(*type);
    }
    return event;
  }

  void read_records() {
    const std::size_t end = check_sum_is_right() ? bytes_.size() - kCheckSum : bytes_.size();
    Event* last = nullptr;
    std::uint16_t last_id = 0;
    while (end - at_ >= kEventId) {
      const auto id = load<std::uint16_t>(bytes_.data() + at_);
      if (last == nullptr || id != last_id) {
        const auto known = event_of_.find(id);
        last = known == event_of_.end() ? nullptr : &events_[known->second];
        last_id = id;
      }
      if (last == nullptr) {
        if (end - at_ > kCheckSum)
          damage_.add(at_, fmt::format("event {} is not described: what follows cannot be read", id));
        return;
      }
      Event& event = *last;
      if (end - at_ < kEventId + event.size) return;  // the last one, not written whole
      event.begins.push_back(at_ + kEventId);
      at_ += kEventId + event.size;
    }
  }

  bool check_sum_is_right() {
    if (bytes_.size() - at_ < kCheckSum) return false;
    const std::size_t end = bytes_.size() - kCheckSum;
    const bool right = crc32(bytes_.substr(0, end)) == load<std::uint32_t>(bytes_.data() + end);
    if (!right) damage_.add(end, "the check sum is another one: the file is cut or damaged");
    return right;
  }

  void make_stream(const Event& event) {
    LogStream stream;
    stream.name = event.name;
    stream.fields = unpack(bytes_, event.begins, event.fields);
    set_clock(stream, event.fields.front().name, 0, event.fields.front().scale);
    out_.streams.push_back(std::move(stream));
  }

  std::string_view bytes_;
  LogStreams out_;
  DamageNotes damage_;
  std::size_t at_ = 0;
  int version_ = 0;
  std::vector<Event> events_;
  std::map<std::uint16_t, std::size_t> event_of_;  ///< index by id
};

}  // namespace

bool CrazyflieFormat::recognises(std::string_view first) {
  if (first.size() < 3 || first.front() != kMagic) return false;
  const auto version = load<std::uint16_t>(first.data() + 1);
  return version == 1 || version == 2;
}

LogStreams CrazyflieFormat::read(std::string_view bytes, const std::string& file) {
  return Reader(bytes, file).run();
}

}  // namespace ident
