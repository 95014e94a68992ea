// A flight log in SI units, body FRD and world NED, with channels that may be sampled at different times.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ident/result/finding.h"

namespace ident {

/// Samples of one group of signals; NaN where a component was not sampled at that row.
/// All channels share the log's time axis `t`; an absent group has no rows.
struct FlightLog {
  std::string file;
  std::vector<double> t;                   ///< s, strictly increasing
  std::vector<std::vector<double>> delta;  ///< [rotor][row] normalised command that holds from t[i] to t[i+1]
  std::vector<std::vector<double>> Omega;  ///< [rotor][row] measured rotor speed, rad/s
  std::array<std::vector<double>, 3> w_B;  ///< p, q, r, rad/s
  std::array<std::vector<double>, 3> f_B;  ///< specific force, m/s^2
  std::array<std::vector<double>, 4> q_WB;     ///< attitude, Hamilton, scalar first, body to world
  std::array<std::vector<double>, 3> x_W;      ///< position NED, m
  std::array<std::vector<double>, 3> v_W;      ///< velocity NED, m/s
  std::vector<double> vbat;                    ///< V
  std::vector<double> current;                 ///< A
  std::vector<std::array<double, 2>> windows;  ///< parts to use, s; empty: all
  bool windows_found = false;  ///< they are from takeoff to landing, as the log tells; else they were chosen
  std::vector<std::array<double, 2>> left_out;  ///< parts not to use, [from, until) s
  double loop = 0.0;           ///< s, of the controller that makes the commands; 0: not stated
  bool each_command = false;   ///< the log has all that it states to make
  std::vector<double> breaks;  ///< s; the row after such a time does not continue the one at it
  std::vector<Warning> warnings;
  std::vector<std::string> notices;  ///< units, frames and rates as they were decided

  std::size_t rows() const { return t.size(); }
  bool has_commands() const { return !delta.empty(); }
  bool has_rotor_speeds() const { return !Omega.empty(); }
  bool has_rates() const { return !w_B[0].empty(); }
  bool has_specific_force() const { return !f_B[0].empty(); }
  bool has_attitude() const { return !q_WB[0].empty(); }
  bool has_position() const { return !x_W[0].empty(); }
  bool has_velocity() const { return !v_W[0].empty(); }
};

/// The windows of a log; where they were found, without what the ground may have pushed, s.
std::vector<std::array<double, 2>> windows_off_ground(const FlightLog& log);

}  // namespace ident
