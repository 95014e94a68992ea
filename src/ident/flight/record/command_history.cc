// Fills in commands of lost rows. Held over them a command is late by half of the gap: 300 losses of 2 to 4
// rows in 40 s make motors come out 1 % too fast.
#include "ident/flight/record/command_history.h"

#include <algorithm>
#include <cmath>

#include "ident/data/sampling.h"
#include "ident/model/flight.h"

namespace ident {
namespace {

constexpr double kLost = 1.6;     // usual steps between two rows, above which rows are lost
constexpr double kLongest = 0.1;  // s; a line over more says nothing
constexpr double kRegular = 0.2;  // largest share of long steps in a regular log

// The rows after which rows are lost: new commands come in the very next row, but late. Where other messages
// come in between, nothing is lost.
std::vector<bool> lost_after(const FlightLog& log, const NewSamples& anew) {
  std::vector<bool> lost(log.rows());
  std::size_t count = 0;
  for (std::size_t k = 1; k < anew.rows.size(); ++k) {
    const std::size_t row = anew.rows[k - 1];
    const double step = log.t[anew.rows[k]] - log.t[row];
    if (anew.rows[k] != row + 1 || !(step > kLost * anew.apart && step < kLongest) ||
        std::ranges::find(log.breaks, log.t[row]) != log.breaks.end())
      continue;
    lost[row] = true, ++count;
  }
  if (!(static_cast<double>(count) < kRegular * static_cast<double>(anew.rows.size())))
    lost.assign(log.rows(), false);
  return lost;
}

}  // namespace

std::vector<HeldCommand> command_history(const FlightLog& log, double from, double to) {
  const NewSamples anew = new_samples(log.t, log.delta);
  const std::vector<bool> lost = lost_after(log, anew);
  const auto before = std::ranges::upper_bound(log.t, from) - log.t.begin();
  std::vector<HeldCommand> history;
  for (const std::vector<double>& column : log.delta) {
    HeldCommand command;
    bool any = false;
    auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(before - 1, 0));
    while (i > 0 && std::isnan(column[i])) --i;
    for (; i < log.rows(); ++i) {
      if (std::isnan(column[i])) continue;
      command.append(log.t[i], column[i]), any = true;
      if (log.t[i] > to) break;
      if (!lost[i]) continue;
      const double step = log.t[i + 1] - log.t[i], count = std::round(step / anew.apart);
      for (double k = 1; k < count; ++k)
        command.append(log.t[i] + k / count * step, column[i] + k / count * (column[i + 1] - column[i]));
    }
    if (!any) command.append(log.t.front(), 0.0);
    history.push_back(std::move(command));
  }
  return history;
}

std::vector<double> command_jumps(const FlightLog& log) {
  constexpr double kHeld = 0.75;  // of a long step: changes that come every 8 ms or later
  const NewSamples anew = new_samples(log.t, log.delta);
  if (!(anew.apart > kHeld * kLongStep)) return {};
  std::vector<double> jumps;
  for (const std::size_t row : anew.rows) jumps.push_back(log.t[row]);
  return jumps;
}

std::vector<HeldCommand> commands_along_lines(const FlightLog& log, double from, double to, int steps) {
  const NewSamples anew = new_samples(log.t, log.delta);
  // Where the commands of all rotors never come together, or not by then, there are no lines.
  if (anew.rows.empty() || log.t[anew.rows.front()] > to) return command_history(log, from, to);
  std::vector<HeldCommand> history(log.delta.size());
  for (std::size_t k = 0; k < anew.rows.size() && log.t[anew.rows[k]] <= to; ++k) {
    const std::size_t row = anew.rows[k], next = k + 1 < anew.rows.size() ? anew.rows[k + 1] : row;
    if (next != row && log.t[next] < from) continue;
    const double apart = log.t[next] - log.t[row];
    const double count = apart < kLongest ? std::max(1.0, steps * std::round(apart / anew.apart)) : 1.0;
    for (std::size_t n = 0; n < history.size(); ++n)
      for (double j = 0; j < count; ++j)
        history[n].append(log.t[row] + j / count * apart,
                          log.delta[n][row] + j / count * (log.delta[n][next] - log.delta[n][row]));
  }
  return history;
}

}  // namespace ident
