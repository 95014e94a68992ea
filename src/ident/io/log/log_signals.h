// The signals of a flight log: names, groups, units.
#pragma once

#include <string>
#include <vector>

#include "ident/io/csv/read_table.h"

namespace ident {

/// Signals that belong together: a map that names one of a group speaks for all of it.
enum class LogGroup {
  time,
  command,
  rotor_speed,
  rates,
  specific_force,
  attitude,
  position,
  velocity,
  battery
};

struct LogSignal {
  Signal signal;
  LogGroup group;
};

/// All signals with numbered ones up to `rotors`.
std::vector<LogSignal> log_signals(int rotors);

/// What a file is read for: a flight with what drove its motors, or how a body moved and nothing else, as
/// motion capture records it.
enum class LogContent { flight, motion };

/// Whether a file that is read for that is asked for signals of the group.
bool is_read(LogGroup group, LogContent content);

/// How many rotors a set of names counts: the highest N of `prefix`N; 0 without any.
int highest_number(const std::vector<std::string>& names, const std::string& prefix);

constexpr int kMostRotors = 32;

}  // namespace ident
