// Puts signals of different rates on one axis of time, and counts rotors.
#include "ident/io/log/stream_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "ident/core/error.h"
#include "ident/core/parse_number.h"
#include "ident/core/statistics.h"
#include "ident/io/log/airborne.h"
#include "ident/io/log/stream_signals.h"

namespace ident {
namespace {

class Maker {
 public:
  Maker(const LogStreams& log, const Vehicle& vehicle, const LogMap& map, LogContent content)
      : log_(log), content_(content), signals_(stream_signals(log, map)) {
    out_.map = map;
    out_.vehicle = vehicle;
    out_.table.file = log.file;
  }

  StreamTable run() {
    if (log_.streams.empty()) fail("the log holds no samples");
    if (content_ == LogContent::motion) {
      leave_motion();
    } else {
      count_rotors();
      take_command_range();
      expect_something();
      take_windows();
      take_loop();
    }
    fill();
    tell_sources();
    tell_damage();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(log_.file, 0, "", what); }

  static bool changes(const StreamSignal& signal) {
    return std::ranges::adjacent_find(signal.values, std::ranges::not_equal_to()) != signal.values.end();
  }

  /// Signals `prefix`1..N, of which a log may hold more than there are motors: those that never change.
  int count(const std::string& prefix) {
    std::vector<std::string> live;
    for (const StreamSignal& signal : signals_.list)
      if (changes(signal)) live.push_back(signal.name);
    const int driven = highest_number(live, prefix);
    const int rotors = static_cast<int>(out_.vehicle.rotors.size());
    if (rotors > 0 && driven > rotors)
      fail(fmt::format("the log has {}1..{}, but the vehicle {} has {} rotors", prefix, driven,
                       out_.vehicle.name, rotors));
    const int n = driven == 0 ? 0 : std::max(driven, rotors);
    std::erase_if(signals_.list,
                  [&](const StreamSignal& signal) { return highest_number({signal.name}, prefix) > n; });
    for (int i = 1; i <= n; ++i)
      if (!signals_.find(fmt::format("{}{}", prefix, i)))
        fail(fmt::format("{}{} is not in the log, but {}{} is", prefix, i, prefix, n));
    return n;
  }

  void count_rotors() {
    out_.columns.commands = count("delta");
    out_.columns.pulses = count("u");
    out_.columns.speeds = count("omega");
    out_.columns.time_unit_stated = true;
    if (out_.columns.commands > 0 && out_.columns.pulses > 0) {
      std::erase_if(signals_.list, [](const StreamSignal& s) { return highest_number({s.name}, "u") > 0; });
      out_.columns.pulses = 0;
    }
  }

  /// The first parameter of a list that holds a pulse width.
  std::optional<double> pulse(const std::vector<std::string>& names) const {
    for (const std::string& name : names)
      if (const auto value = log_.parameter(name); value && *value > 0) return value;
    return std::nullopt;
  }

  void take_command_range() {
    if (out_.columns.pulses == 0 || out_.vehicle.command) return;
    const auto min = pulse(out_.map.command[0]), max = pulse(out_.map.command[1]);
    if (!min || !max || *max <= *min)
      fail(
          "commands are pulse widths: their range is neither in the log nor, as 'command: {min: .., max: "
          "..}', in "
          "the vehicle file");
    out_.vehicle.command = CommandRange{*min, *max};
    out_.table.notices.push_back(fmt::format(
        "{}: command 0 is {} us and 1 is {} us, as the log's parameters say", log_.file, *min, *max));
  }

  bool has(std::initializer_list<LogGroup> groups) const {
    return std::ranges::any_of(signals_.list, [&](const StreamSignal& s) {
      return std::ranges::find(groups, s.group) != groups.end();
    });
  }

  std::string stream_list() const {
    constexpr std::size_t kShown = 12;  // streams; PX4 logs a hundred
    std::vector<std::string> names;
    for (const LogStream& stream : log_.streams)
      if (names.size() < kShown) names.push_back(stream.name);
    return fmt::format("{}{}", fmt::join(names, ", "),
                       names.size() < log_.streams.size()
                           ? fmt::format(" and {} more", log_.streams.size() - names.size())
                           : "");
  }

  void leave_motion() {
    std::erase_if(signals_.list, [&](const StreamSignal& s) { return !is_read(s.group, content_); });
    out_.columns.time_unit_stated = true;
    if (!has({LogGroup::attitude})) fail("no attitude is in the recording; its streams: " + stream_list());
  }

  void expect_something() const {
    const std::string list = stream_list();
    if (!has({LogGroup::command, LogGroup::rotor_speed}))
      fail("neither commands of motors nor rotor speeds are in the log; its streams: " + list);
    if (!has({LogGroup::rates, LogGroup::specific_force, LogGroup::attitude, LogGroup::velocity}))
      fail("nothing that moves is in the log: rates, specific force, attitude or velocity; its streams: " +
           list);
  }

  void take_windows() {
    if (!out_.map.windows.empty()) return;
    const auto flown = airborne(log_, out_.map.airborne, signals_);
    if (!flown) {
      if (!out_.map.airborne.empty())
        out_.table.notices.push_back(log_.file +
                                     ": takeoff and landing are not in the log: all of it is used");
      return;
    }
    if (flown->empty())
      throw DataError(log_.file +
                      ": the vehicle does not fly in this log; 'windows' in a map (--map) choose a "
                      "part of it nevertheless");
    out_.map.windows = *flown;
    double sum = 0.0;
    for (const auto& [from, until] : *flown) sum += until - from;
    out_.table.notices.push_back(
        fmt::format("{}: {:.1f} s between takeoff and landing are used", log_.file, sum));
  }

  /// Whether commands came as often as the controller makes them.
  void take_loop() {
    constexpr double kAsOften = 0.9;
    const StreamSignal* commands = signals_.find("delta1");
    if (!commands || commands->t.size() < 2) return;
    std::vector<double> steps;
    for (std::size_t i = 1; i < commands->t.size(); ++i) steps.push_back(commands->t[i] - commands->t[i - 1]);
    const double step = median(std::move(steps));
    for (const std::string& rate : out_.map.controller_rate)
      if (const auto hz = parse_number(rate) ? parse_number(rate) : log_.parameter(rate); hz && *hz > 0) {
        out_.loop = 1 / *hz, out_.each_command = 1 / step > kAsOften * *hz;
        return;
      }
  }

  void fill() {
    std::vector<double> t;
    for (const StreamSignal& signal : signals_.list) t.insert(t.end(), signal.t.begin(), signal.t.end());
    std::ranges::sort(t);
    t.erase(std::ranges::unique(t).begin(), t.end());
    NumberTable& table = out_.table;
    for (StreamSignal& signal : signals_.list) {
      std::vector<double> values(t.size(), kNaN);
      std::size_t row = 0;
      for (std::size_t i = 0; i < signal.t.size(); ++i) {
        while (t[row] < signal.t[i]) ++row;
        values[row] = signal.values[i];
      }
      table.columns.push_back({signal.name, signal.stream + " " + signal.column, std::move(values)});
      std::vector<double>().swap(signal.t);
      std::vector<double>().swap(signal.values);
    }
    table.line.assign(t.size(), 0);
    table.columns.push_back({"t", "time", std::move(t)});
    std::erase_if(out_.map.windows, [&](const auto& window) {
      const auto& rows = table.columns.back().values;
      return out_.map.windows_line == 0 &&
             std::ranges::upper_bound(rows, window[1]) - std::ranges::lower_bound(rows, window[0]) < 2;
    });
  }

  void tell_sources() {
    std::vector<std::pair<std::string, std::vector<std::string>>> sources;
    for (const StreamSignal& signal : signals_.list) {
      auto at = std::ranges::find(sources, signal.stream, [](const auto& source) { return source.first; });
      if (at == sources.end()) at = sources.insert(at, {signal.stream, {}});
      at->second.push_back(signal.name);
    }
    std::string text;
    for (const auto& [stream, names] : sources)
      text += fmt::format("{}{} from {}", text.empty() ? "" : "; ", fmt::join(names, " "), stream);
    out_.table.notices.push_back(log_.file + ": " + text);
    std::map<double, std::string> unfiltered;
    for (const StreamSignal& signal : signals_.list)
      if (signal.unfiltered > 0) unfiltered[signal.unfiltered] += signal.name + " ";
    for (const auto& [lag, names] : unfiltered)
      out_.table.notices.push_back(
          fmt::format("{}: {}went through a low-pass on the vehicle, {:.3g} ms late, which was taken back",
                      log_.file, names, 1e3 * lag));
    if (const auto commands = log_.facts.find("commands"); commands != log_.facts.end())
      out_.table.notices.push_back(log_.file + ": " + commands->second);
  }

  void tell_damage() {
    for (const Warning& warning : signals_.warnings) out_.table.warnings.push_back(warning);
    if (!log_.damage.empty())
      out_.table.warnings.push_back({"damaged_log", fmt::format("{}: parts of the log cannot be read: {}",
                                                                log_.file, fmt::join(log_.damage, "; "))});
    double lost = 0.0;
    for (const auto& [from, until] : log_.dropouts) lost += until - from;
    if (lost > 0)
      out_.table.warnings.push_back(
          {"log_dropouts",
           fmt::format("{}: the logger lost samples {} times, {:.2f} s in all: a faster card, or "
                       "fewer topics, avoids that",
                       log_.file, log_.dropouts.size(), lost)});
  }

  const LogStreams& log_;
  LogContent content_;
  StreamSignals signals_;
  StreamTable out_;
};

}  // namespace

StreamTable make_stream_table(const LogStreams& log, const Vehicle& vehicle, const LogMap& map,
                              LogContent content) {
  return Maker(log, vehicle, map, content).run();
}

}  // namespace ident
