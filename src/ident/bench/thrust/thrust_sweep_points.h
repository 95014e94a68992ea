// What is fitted: steady points of one force over rotor speed, and its readings at rest.
#pragma once

#include <string>
#include <vector>

#include "ident/bench/thrust/thrust_sweep_rows.h"
#include "ident/core/math.h"

namespace ident {

/// One steady point: a row of a table, or the robust mean over a dwell of a log.
struct SweepPoint {
  double Omega = 0.0;  ///< rad/s
  double value = 0.0;  ///< N or N m, positive when the propeller works as it should
  double place = 0.0;  ///< s or row
  int set_point = -1;
};

/// Thrust or torque of one file.
struct SweepChannel {
  std::string name, unit;
  std::vector<SweepPoint> moving;
  std::vector<double> rest;        ///< readings at rest; of a log one mean for each stay
  std::vector<double> rest_place;  ///< s or row of each
  /// Tare of a log and how well it is known, from its rows at rest; NaN: the fit finds it out.
  double rest_mean = kNaN, rest_std = kNaN;
  bool drifts = false;    ///< the tare of a log changes from stay to stay; its drift is taken off the points
  bool reversed = false;  ///< the file shows it negative; turned round here
  double start_constant = 0.0, start_tare = 0.0;  ///< rough: median slope over Omega^2
  std::size_t rows = 0;                           ///< that have a value and a speed
  std::size_t used = 0;                           ///< that went into the points

  double full_scale() const;  ///< largest value less the tare, gross slips aside
};

/// How the points of a file came about.
struct SweepPoints {
  SweepChannel thrust, torque;  ///< torque without points where the file has none
  bool averaged = false;        ///< points are means over dwells, or over stretches of a ramp
  bool ramp = false;            ///< rows without a time, of a speed that hardly ever stays
  double lag = kNaN;            ///< s by which the forces trail the speed; only where nothing is steady
  bool has_torque() const { return !torque.moving.empty(); }
};

/// Throws DataError when too few steady points are left.
SweepPoints sweep_points(const SweepRows& rows);

}  // namespace ident
