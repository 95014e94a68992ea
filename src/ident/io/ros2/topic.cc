// One topic of a bag: its messages as they come, and the stream that they make.
#include "ident/io/ros2/topic.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "ident/io/ros2/msg_text.h"

namespace ident::ros2 {

namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;
constexpr std::int64_t one_hour_ns = 3600 * ns_per_s;

/// Differences of times of damaged files may not fit: they wrap.
std::int64_t wrapping_difference(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

template <typename Number>
const std::vector<Number>* numbers(const MessageColumns& columns, std::string_view name) {
  const StreamField* field = columns.find(name);
  return field ? std::get_if<std::vector<Number>>(&field->values) : nullptr;
}

}  // namespace

Topic::Topic(std::string name, std::string type, Definitions definitions)
    : name_(std::move(name)),
      type_(std::move(type)),
      definitions_(std::make_unique<const Definitions>(std::move(definitions))),
      columns_(std::make_unique<MessageColumns>(*definitions_, plain_type_name(type_))) {}

void Topic::add(std::int64_t log_time_ns, std::span<const std::uint8_t> message) {
  if (!problem().empty()) return;
  if (columns_->add(message))
    log_times_.push_back(log_time_ns);
  else
    ++unreadable_;
}

std::vector<std::int64_t> Topic::stamps_ns(std::string& clock) const {
  std::vector<std::int64_t> stamps;
  const auto* seconds = numbers<std::int32_t>(*columns_, "header.stamp.sec");
  const auto* nanoseconds = numbers<std::uint32_t>(*columns_, "header.stamp.nanosec");
  const auto* microseconds = numbers<std::uint64_t>(*columns_, "timestamp");
  if (seconds && nanoseconds) {
    clock = "header.stamp";
    for (std::size_t i = 0; i < seconds->size(); ++i)
      stamps.push_back(std::int64_t{(*seconds)[i]} * ns_per_s + (*nanoseconds)[i]);
  } else if (microseconds && type_.starts_with("px4_msgs/")) {
    clock = "timestamp";
    for (const std::uint64_t us : *microseconds) stamps.push_back(static_cast<std::int64_t>(us * 1000));
  } else {
    return log_times_;
  }
  // Publishers that do not stamp leave zero.
  if (std::all_of(stamps.begin(), stamps.end(), [](std::int64_t t) { return t == 0; })) {
    clock.clear();
    return log_times_;
  }
  return stamps;
}

void Topic::add_to(LogStreams& streams, std::int64_t start_ns) {
  if (!problem().empty()) {
    streams.damage.push_back(fmt::format("topic {} ({}) is not read: {}", name_, type_, problem()));
    return;
  }
  if (unreadable_ > 0)
    streams.damage.push_back(
        fmt::format("topic {}: {} messages do not fit their type {}", name_, unreadable_, type_));
  if (log_times_.empty()) return;
  LogStream stream{.name = name_};
  const std::vector<std::int64_t> stamps = stamps_ns(stream.clock);
  std::int64_t zero_ns = start_ns;
  const std::int64_t ahead = wrapping_difference(stamps.front(), log_times_.front());
  if (ahead < -one_hour_ns || ahead > one_hour_ns)
    zero_ns =
        static_cast<std::int64_t>(static_cast<std::uint64_t>(start_ns) + static_cast<std::uint64_t>(ahead));
  stream.t.reserve(stamps.size());
  for (const std::int64_t stamp : stamps)
    stream.t.push_back(1e-9 * static_cast<double>(wrapping_difference(stamp, zero_ns)));
  for (const auto& [field, text] : columns_->texts()) streams.facts[name_ + " " + field] = text;
  streams.facts[name_ + " type"] = type_;
  stream.fields = columns_->take();
  streams.streams.push_back(std::move(stream));
}

void add_topics(std::vector<Topic>& topics, LogStreams& streams) {
  std::int64_t start_ns = std::numeric_limits<std::int64_t>::max();
  for (const Topic& topic : topics)
    if (!topic.empty()) start_ns = std::min(start_ns, topic.first_log_time_ns());
  for (Topic& topic : topics) topic.add_to(streams, start_ns);
}

}  // namespace ident::ros2
