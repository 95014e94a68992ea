// What rotor speeds and commands say about each other.
#include "ident/io/log_cleaning/log_checks_rotors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/io/log_cleaning/log_rows.h"

namespace ident {
namespace {

constexpr double kDropOut = 0.3;  // s at zero between turning and turning: no rotor stops for so short
constexpr double kTurns = 0.3;    // of the median

/// Zeros for a short time between samples of a rotor that turns, made NaN; gives their number.
std::size_t drop_zeros(const std::vector<double>& t, std::vector<double>& Omega) {
  const double turning = kTurns * middle_of(Omega).value_or(0.0);
  std::size_t dropped = 0, last = Omega.size();  // last: sample of the turning rotor
  for (std::size_t i = 0; i < Omega.size(); ++i) {
    if (std::isnan(Omega[i]) || Omega[i] == 0.0) continue;
    if (last < i && Omega[last] > turning && Omega[i] > turning && t[i] - t[last] < kDropOut)
      for (std::size_t k = last + 1; k < i; ++k)
        if (Omega[k] == 0.0) Omega[k] = kNaN, ++dropped;
    last = i;
  }
  return dropped;
}

}  // namespace

void check_rotor_speeds(FlightLog& log, Components Omega) {
  if (rows_of(Omega).empty()) return clear_all(Omega);
  std::size_t negative = 0, dropped = 0;
  for (std::vector<double>& speed : Omega) {
    negative += std::ranges::any_of(speed, [](double v) { return v < 0; });
    for (double& v : speed) v = std::abs(v);
    dropped += drop_zeros(log.t, speed);
  }
  if (negative > 0)
    log.warnings.push_back(
        {"rotor_speed_sign",
         fmt::format("{}: {} of {} rotor speeds are negative: their sizes are taken; which way a rotor turns "
                     "stands in the vehicle file",
                     log.file, negative, Omega.size())});
  if (dropped > 0)
    log.warnings.push_back({"rotor_speed_dropouts",
                            fmt::format("{}: rotor speeds drop to zero for a moment in {} samples: those "
                                        "count as not sampled",
                                        log.file, dropped)});
  for (std::size_t n = 0; n < Omega.size(); ++n) {
    const std::vector<std::size_t> rows = rows_of(Omega.subspan(n, 1));
    if (rows.size() < kFewRows ||
        !std::ranges::all_of(rows, [&](std::size_t i) { return Omega[n][i] == Omega[n][rows[0]]; }))
      continue;
    clear_all(Omega);
    log.warnings.push_back(
        {"constant_signal",
         fmt::format("{}: omega{}: never changes; rotor speeds are taken as not measured", log.file, n + 1)});
    return;
  }
}

void check_commands(FlightLog& log) {
  std::vector<std::string> dead;
  for (std::size_t n = 0; n < log.delta.size() && n < log.Omega.size(); ++n) {
    const auto moves = [&](const std::vector<double>& column) {
      const std::span<const std::vector<double>> one(&column, 1);
      const std::vector<std::size_t> rows = rows_of(one);
      return rows.size() >= kFewRows &&
             !std::ranges::all_of(rows, [&](std::size_t i) { return same(one, i, rows.front()); });
    };
    if (!moves(log.delta[n]) && moves(log.Omega[n])) dead.push_back(std::to_string(n + 1));
  }
  if (dead.empty()) return;
  const bool speeds =
      log.Omega.size() == log.delta.size() && std::ranges::all_of(log.Omega, [&](const auto& c) {
        return rows_of(std::span(&c, 1)).size() > log.rows() / 2;
      });
  log.warnings.push_back(
      {"constant_command",
       fmt::format(
           "{}: the command of rotor {} never changes, and its speed does: is the column the right "
           "one? {}",
           log.file, fmt::join(dead, ", "),
           speeds ? "The commands are left out, the speeds are the input, and the motors are not estimated"
                  : "Nothing that depends on commands can be trusted")});
  if (speeds) log.delta.clear();
}

}  // namespace ident
