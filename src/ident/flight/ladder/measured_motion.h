// What was measured along a flight, in the form in which a model is compared with it over short windows.
#pragma once

#include <vector>

#include "ident/flight/record/flight_record.h"

namespace ident {

/// An arc of the record with its attitude, and the velocity that forces other than gravity gave it.
struct MeasuredArc {
  const FlightArc* arc = nullptr;
  std::vector<std::size_t> row;         ///< those of the arc that are looked at: a hundred a second
  std::vector<double> t;                ///< s
  std::vector<BodyState<double>> body;  ///< attitude from rates alone where none was logged
  std::vector<Vec3<double>> gained_W;   ///< v_W - g t, or the integral of the specific force, m/s
};

struct MeasuredMotion {
  const FlightRecord* record = nullptr;
  std::vector<MeasuredArc> arcs;
  bool forces = false;    ///< a velocity or a specific force was logged, and how the vehicle turned
  bool moments = false;   ///< rates were logged, or an attitude
  bool velocity = false;  ///< attitude and velocity: the motion can be predicted open loop
  bool speeds = false;    ///< of the rotors were logged beside commands
};

/// The record must outlive it.
MeasuredMotion measured_motion(const FlightRecord& record);

/// Usual time between the rows that are looked at, s.
double typical_row(const MeasuredMotion& motion);

/// A piece of flight over which a model is compared with what was measured: rows of a measured arc.
struct Window {
  std::size_t arc = 0, begin = 0, end = 0;
  double t = 0.0;      ///< start, s
  double speed = 0.0;  ///< mean over it, m/s
};

/// Windows of `horizon` seconds that begin every `spacing` seconds, within the arcs.
std::vector<Window> windows_of(const MeasuredMotion& motion, double horizon, double spacing);

}  // namespace ident
