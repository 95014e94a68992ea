// Applies rules of takeoff and landing.
#include "ident/io/log/airborne.h"

#include <algorithm>

namespace ident {
namespace {

using Windows = std::vector<std::array<double, 2>>;

constexpr double kShortest = 1.0;  // s; hops and pauses below that are none

/// Intervals in which a condition holds, from the samples at which it begins to the ones at which it ends.
class Intervals {
 public:
  void sample(double t, bool holds) {
    if (holds && !from_) from_ = t;
    if (!holds && from_) close(t);
    last_ = t;
  }
  /// Those that last, with short pauses between them passed over.
  Windows finish() {
    if (from_) close(last_);
    Windows joined;
    for (const auto& window : list_)
      if (!joined.empty() && window[0] - joined.back()[1] < kShortest)
        joined.back()[1] = window[1];
      else
        joined.push_back(window);
    std::erase_if(joined, [](const auto& window) { return window[1] - window[0] < kShortest; });
    return joined;
  }

 private:
  void close(double t) {
    list_.push_back({*from_, t});
    from_.reset();
  }
  std::optional<double> from_;
  double last_ = 0.0;
  Windows list_;
};

/// A state, or events between which it holds. The last state holds to the end of the log.
std::optional<Windows> by_stream(const LogStreams& log, const AirborneRule& rule) {
  const LogStream* stream = find_stream(log, rule.stream);
  const StreamField* field = stream ? stream->find(rule.column) : nullptr;
  if (!field || stream->t.empty()) return std::nullopt;
  Intervals intervals;
  bool flies = false, told = rule.is.has_value();
  for (std::size_t i = 0; i < stream->t.size(); ++i) {
    const double value = field->at(i);
    if (rule.is) {
      flies = value == *rule.is;
    } else if (value == *rule.from || value == *rule.until) {
      flies = value == *rule.from;
      told = true;
    }
    intervals.sample(stream->t[i], flies);
  }
  double end = stream->t.back();
  for (const LogStream& other : log.streams)
    if (!other.t.empty()) end = std::max(end, other.t.back());
  if (flies) intervals.sample(end, true);
  return told ? std::optional(intervals.finish()) : std::nullopt;
}

std::optional<Windows> by_commands(const StreamSignals& signals, double above) {
  std::vector<const StreamSignal*> commands;
  for (const StreamSignal& signal : signals.list)
    if (signal.group == LogGroup::command && signal.name.starts_with("delta")) commands.push_back(&signal);
  if (commands.empty()) return std::nullopt;
  Intervals intervals;
  for (std::size_t i = 0; i < commands.front()->t.size(); ++i) {
    double sum = 0.0, count = 0.0;
    for (const StreamSignal* command : commands)
      if (i < command->values.size()) sum += command->values[i], count += 1.0;
    intervals.sample(commands.front()->t[i], sum > above * count);
  }
  return intervals.finish();
}

}  // namespace

std::optional<Windows> airborne(const LogStreams& log, const std::vector<AirborneRule>& rules,
                                const StreamSignals& signals) {
  for (const AirborneRule& rule : rules) {
    const std::optional<Windows> found =
        rule.stream.empty() ? by_commands(signals, rule.commands_above) : by_stream(log, rule);
    if (found) return found;
  }
  return std::nullopt;
}

}  // namespace ident
