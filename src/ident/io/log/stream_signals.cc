// Finds the fields that a map names, and takes their samples.
#include "ident/io/log/stream_signals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/core/nearest_word.h"
#include "ident/core/parse_number.h"
#include "ident/io/csv/units.h"
#include "ident/io/log/undo_low_pass.h"

namespace ident {
namespace {

constexpr double kMicrosecond = 1e-6;  // s
constexpr int kMostOutputs = 32;

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
  if (const std::size_t at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

/// Where a line of a map leads to in a log.
struct Source {
  const LogStream* stream = nullptr;
  const StreamField* field = nullptr;
};

class Finder {
 public:
  Finder(const LogStreams& log, const LogMap& map) : log_(log), map_(map) {}

  bool has(const MappedColumn& mapped) const {
    return find(mapped).field != nullptr ||
           std::ranges::any_of(mapped.otherwise, [&](const MappedColumn& other) { return has(other); });
  }

  StreamSignals run() {
    for (const LogSignal& s : log_signals(kMostRotors)) {
      const auto at = map_.columns.find(s.signal.name);
      if (at == map_.columns.end() || s.group == LogGroup::time || at->second.column.empty()) continue;
      if (!take(s, at->second) && at->second.must_be_there) fail(at->second);
    }
    return std::move(out_);
  }

 private:
  /// The first of a line and its alternatives that the log has samples of.
  bool take(const LogSignal& signal, const MappedColumn& mapped) {
    const Source source = find(mapped);
    const std::optional<Line> line = line_of(mapped);
    if (source.field && line) {
      StreamSignal found = samples(signal, mapped, source, *line);
      if (!found.t.empty()) {
        out_.list.push_back(std::move(found));
        return true;
      }
    }
    return std::ranges::any_of(mapped.otherwise,
                               [&](const MappedColumn& other) { return take(signal, other); });
  }

  /// Output that drives a motor, by the parameters of the log; the motor's own number where it has none.
  std::optional<int> output_of(int motor) const {
    if (map_.output_function.empty()) return motor;
    if (motor > static_cast<int>(map_.motor_functions.size())) return std::nullopt;
    bool stated = false;
    for (int k = 1; k <= kMostOutputs; ++k) {
      const auto function = log_.parameter(with_replaced(map_.output_function, "{k}", std::to_string(k)));
      stated = stated || function.has_value();
      if (function && *function == map_.motor_functions[static_cast<std::size_t>(motor - 1)]) return k;
    }
    return stated ? std::nullopt : std::optional(motor);
  }

  Source find(const MappedColumn& mapped) const {
    std::string column = mapped.column;
    if (column.find("{output") != std::string::npos) {
      const std::optional<int> output = output_of(mapped.number);
      if (!output) return {};
      column = with_replaced(with_replaced(column, "{output}", std::to_string(*output)), "{output-1}",
                             std::to_string(*output - 1));
    }
    if (!mapped.stream.empty()) {
      const LogStream* stream = find_stream(log_, mapped.stream);
      return {stream, stream ? stream->find(column) : nullptr};
    }
    Source most;
    for (const LogStream& stream : log_.streams)
      if (const StreamField* field = is_measured(stream) ? stream.find(column) : nullptr)
        if (!most.field || field->size() > most.field->size()) most = {&stream, field};
    return most;
  }

  /// What is wanted of a vehicle bears the same fields as what it did.
  bool is_measured(const LogStream& stream) const {
    return std::ranges::none_of(map_.not_streams, [&](const std::string& word) {
      return stream.name.find(word) != std::string::npos;
    });
  }

  /// value = factor * number + offset. Nothing where the log does not state a parameter that it takes.
  struct Line {
    double factor = 1.0, offset = 0.0;
  };
  std::optional<Line> line_of(const MappedColumn& mapped) const {
    Line line{mapped.scale, mapped.offset};
    if (!mapped.by.empty()) line.factor *= log_.parameter(mapped.by).value_or(0.0);
    if (!mapped.per.empty()) {
      const double per = log_.parameter(mapped.per).value_or(0.0);
      line.factor = per == 0.0 ? 0.0 : line.factor / per;
    }
    if (!mapped.range[0].empty()) {
      const auto zero = log_.parameter(mapped.range[0]), one = log_.parameter(mapped.range[1]);
      if (!zero || !one || *one <= *zero) return std::nullopt;
      line.factor /= *one - *zero;
      line.offset -= line.factor * *zero;
    }
    return line.factor == 0.0 ? std::nullopt : std::optional(line);
  }

  double unit_of(const MappedColumn& mapped, const Signal& signal, const StreamField& field) const {
    if (mapped.unit.empty()) return unit_factor(field.unit, signal.dimension).value_or(1.0);
    if (const std::optional<double> factor = unit_factor(mapped.unit, signal.dimension)) return *factor;
    throw InputError(map_.file, mapped.line, signal.name,
                     fmt::format("unit '{}' is not known for this signal; known: {}", mapped.unit,
                                 known_units(signal.dimension)));
  }

  /// The low-pass that a signal went through; without a lag where there is none, or the log does not state
  /// it.
  LowPass filter_of(const MappedColumn& mapped) const {
    const auto stated = [&](const std::string& text, const char* unit) {
      if (text.empty()) return 0.0;
      if (const std::optional<double> number = parse_number(text)) return *number;
      const std::optional<double> of_log = log_.parameter(text);
      if (!of_log && mapped.must_be_there)
        throw InputError(
            map_.file, mapped.line, "behind",
            fmt::format("'{}' is neither a number of {} nor a parameter of the log", text, unit));
      return of_log.value_or(0.0);
    };
    if (const double cutoff = stated(mapped.behind.cutoff, "Hz"); cutoff > 0) return butterworth(cutoff);
    return {.lag = stated(mapped.behind.lag, "s"), .square = stated(mapped.behind.square, "s^2")};
  }

  /// The same conditions with numbers; NaN, which no sample is, where no output drives the motor.
  std::vector<StreamCondition> with_outputs(const MappedColumn& mapped) const {
    std::vector<StreamCondition> where = mapped.where;
    for (StreamCondition& condition : where) {
      if (!condition.of_output) continue;
      const std::optional<int> output = output_of(mapped.number);
      condition.is = output ? *output + condition.is : kNaN;
    }
    return where;
  }

  static bool is_taken(const LogStream& stream, const std::vector<StreamCondition>& where, std::size_t i) {
    return std::ranges::all_of(where, [&](const StreamCondition& condition) {
      const StreamField* field = stream.find(condition.field);
      return !field || field->at(i) == condition.is;
    });
  }

  /// Times of the samples: the stream's, those of the column's own, less by what they are late.
  static std::vector<double> times(const LogStream& stream, const MappedColumn& mapped) {
    std::vector<double> t = stream.t;
    const StreamField* own = mapped.time.empty() ? nullptr : stream.find(mapped.time);
    const StreamField* clock = stream.find(stream.clock);
    if (own && clock)
      for (std::size_t i = 0; i < t.size(); ++i)
        if (own->at(i) > 0) t[i] += (own->at(i) - clock->at(i)) * kMicrosecond;
    if (const StreamField* late = mapped.late_by.empty() ? nullptr : stream.find(mapped.late_by))
      for (std::size_t i = 0; i < t.size(); ++i) t[i] -= mapped.late_by_scale * late->at(i);
    return t;
  }

  StreamSignal samples(const LogSignal& signal, const MappedColumn& mapped, const Source& source,
                       const Line& line) {
    const LogStream& stream = *source.stream;
    StreamSignal found{.name = signal.signal.name,
                       .group = signal.group,
                       .stream = stream.name,
                       .column = source.field->name};
    const double unit = unit_of(mapped, signal.signal, *source.field);
    const std::vector<double> t = times(stream, mapped);
    const std::vector<StreamCondition> where = with_outputs(mapped);
    bool any_number = false;
    long back = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (!where.empty() && !is_taken(stream, where, i)) continue;
      double value = source.field->at(i);
      any_number = any_number || std::isfinite(value);
      if (!std::isfinite(value) && mapped.nan_is) value = *mapped.nan_is;
      if (!std::isfinite(value) || !std::isfinite(t[i])) continue;
      if (!found.t.empty() && t[i] <= found.t.back()) {
        back += t[i] < found.t.back();
        continue;
      }
      found.t.push_back(t[i]);
      found.values.push_back(unit * (line.factor * value + line.offset));
    }
    if (!any_number) found.t.clear();
    if (const LowPass filter = filter_of(mapped); filter.lag > 0 && !found.t.empty()) {
      found.unfiltered = filter.lag;
      undo_low_pass(found.t, found.values, filter);
    }
    if (back > 0)
      out_.warnings.push_back(
          {"time_backward", fmt::format("{}: {} {}: time goes back in {} samples, which were dropped",
                                        log_.file, found.stream, found.column, back)});
    return found;
  }

  [[noreturn]] void fail(const MappedColumn& mapped) const {
    std::vector<std::string> names;
    const LogStream* stream = mapped.stream.empty() ? nullptr : find_stream(log_, mapped.stream);
    if (!mapped.stream.empty() && !stream) {
      for (const LogStream& s : log_.streams) names.push_back(s.name);
      throw InputError(map_.file, mapped.line, mapped.stream,
                       fmt::format("the log {} has no such stream{}; it has: {}", log_.file,
                                   did_you_mean(mapped.stream, names), fmt::join(names, ", ")));
    }
    for (const LogStream& s : log_.streams)
      if (!stream || stream == &s)
        for (const StreamField& field : s.fields) names.push_back(field.name);
    throw InputError(map_.file, mapped.line, mapped.column,
                     fmt::format("the log {} has no sample of such a column{}{}", log_.file,
                                 stream ? " in " + stream->name : "", did_you_mean(mapped.column, names)));
  }

  const LogStreams& log_;
  const LogMap& map_;
  StreamSignals out_;
};

/// A topic of ROS without the version that PX4 appends: `/fmu/out/vehicle_status_v1`.
std::string_view without_version(std::string_view topic) {
  const std::size_t digits = topic.find_last_not_of("0123456789") + 1;
  return digits < topic.size() && topic.substr(0, digits).ends_with("_v") ? topic.substr(0, digits - 2)
                                                                          : topic;
}

}  // namespace

const StreamSignal* StreamSignals::find(std::string_view name) const {
  const auto at = std::ranges::find(list, name, &StreamSignal::name);
  return at == list.end() ? nullptr : &*at;
}

StreamSignals stream_signals(const LogStreams& log, const LogMap& map) { return Finder(log, map).run(); }

bool has_signal(const LogStreams& log, const LogMap& map, const MappedColumn& mapped) {
  return Finder(log, map).has(mapped);
}

const LogStream* find_stream(const LogStreams& log, const std::string& name) {
  if (const LogStream* exact = log.find(name)) return exact;
  if (const LogStream* first = log.find(name + ":0")) return first;
  const LogStream* longest = nullptr;
  for (const LogStream& stream : log.streams) {
    const std::string_view topic = without_version(stream.name);
    if ((stream.name.ends_with(":" + name) || topic.ends_with("/" + name)) &&
        (!longest || stream.t.size() > longest->t.size()))
      longest = &stream;
  }
  return longest;
}

}  // namespace ident
