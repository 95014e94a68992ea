// One topic of a bag: its messages as they come, and the stream that they make.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ident/data/log_streams.h"
#include "ident/io/ros2/definition.h"
#include "ident/io/ros2/message_columns.h"

namespace ident::ros2 {

class Topic {
 public:
  /// `type` is `geometry_msgs/msg/Pose`, as bags name it.
  Topic(std::string name, std::string type, Definitions definitions);

  /// Adds a message that was recorded at `log_time_ns`.
  void add(std::int64_t log_time_ns, std::span<const std::uint8_t> message);
  const std::string& problem() const { return columns_->problem(); }
  std::int64_t first_log_time_ns() const { return log_times_.front(); }
  bool empty() const { return log_times_.empty(); }

  /// Adds the stream. Times are those of `header.stamp` or, of px4_msgs, of `timestamp`; else when the
  /// message was recorded. They count from `start_ns`; a clock more than an hour from that of the recorder
  /// (time since boot, simulated time) is shifted, so that its first message lies where it was recorded.
  void add_to(LogStreams& streams, std::int64_t start_ns);

 private:
  std::vector<std::int64_t> stamps_ns(std::string& clock) const;

  std::string name_;
  std::string type_;
  std::unique_ptr<const Definitions> definitions_;  ///< has a fixed address, the columns refer to it
  std::unique_ptr<MessageColumns> columns_;
  std::vector<std::int64_t> log_times_;
  std::size_t unreadable_ = 0;
};

/// Adds the streams of all topics, on one clock that begins with the first message.
void add_topics(std::vector<Topic>& topics, LogStreams& streams);

}  // namespace ident::ros2
