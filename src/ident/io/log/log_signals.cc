// The list of a flight log's signals.
#include "ident/io/log/log_signals.h"

#include <fmt/format.h>

#include <charconv>

namespace ident {

std::vector<LogSignal> log_signals(int rotors) {
  using enum Dimension;
  std::vector<LogSignal> list = {
      {{"t", time, {{"time", ""}, {"timestamp", ""}, {"t s", "s"}, {"time s", "s"}}, 0.0}, LogGroup::time},
      {{"vbat", voltage, {{"voltage", ""}}, 150.0}, LogGroup::battery},
      {{"current", current, {}, 2000.0}, LogGroup::battery},
  };
  const auto add = [&](LogGroup group, Dimension dimension, double largest,
                       const std::vector<std::string>& names) {
    for (const std::string& name : names) list.push_back({{name, dimension, {}, largest}, group});
  };
  add(LogGroup::rates, angular_rate, 40.0, {"p", "q", "r"});
  add(LogGroup::specific_force, acceleration, 300.0, {"ax", "ay", "az"});
  add(LogGroup::attitude, number, 1.5, {"qw", "qx", "qy", "qz"});
  add(LogGroup::attitude, angle, 6.5, {"phi", "theta"});
  add(LogGroup::attitude, angle, 0.0, {"psi"});  // may count whole turns
  add(LogGroup::position, length, 1e6, {"x", "y", "z"});
  add(LogGroup::velocity, velocity, 300.0, {"vx", "vy", "vz"});
  for (int n = 1; n <= rotors; ++n) {
    list.push_back({{fmt::format("u{}", n), pulse_width, {}, 3000.0}, LogGroup::command});
    list.push_back({{fmt::format("delta{}", n), fraction, {}, 1.5}, LogGroup::command});
    list.push_back({{fmt::format("omega{}", n), angular_rate, {{fmt::format("rpm{}", n), "rpm"}}, 6500.0},
                    LogGroup::rotor_speed});
  }
  return list;
}

bool is_read(LogGroup group, LogContent content) {
  return content == LogContent::flight || group == LogGroup::time || group == LogGroup::attitude ||
         group == LogGroup::position || group == LogGroup::velocity;
}

int highest_number(const std::vector<std::string>& names, const std::string& prefix) {
  int highest = 0;
  for (const std::string& name : names) {
    if (!name.starts_with(prefix)) continue;
    int number = 0;
    const char* end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, number);
    if (error == std::errc() && stop == end && number >= 1 && number <= kMostRotors)
      highest = std::max(highest, number);
  }
  return highest;
}

}  // namespace ident
