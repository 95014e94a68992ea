// Changes of the rates over short windows of flight, and of what each rotor may have done to them.
//
// Over a window the change of the rates is J^-1 times the integral of the moment, [flight model (4)]
//   sum_n (r_n x kT a_n - s_n kQ a_n) Omega_n^2 - sigma s_n Jp a_n Omega_n'
// whose scale does not matter to a correlation, only its pattern over the rotors.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "ident/flight/conditioning/windowed_changes.h"
#include "ident/flight/record/rotor_moments.h"
#include "ident/model/vehicle.h"

namespace ident {

using RotorOrder = std::vector<std::size_t>;  ///< column that drives each rotor

/// What is compared of an arc.
struct Streams {
  std::array<RunningSum, 3> rates;
  std::vector<RunningSum> thrust, spin;  ///< integral of Omega^2, Omega of each column
  std::vector<double> mean_square;       ///< of Omega of each column
};

/// Rotor speeds as measured or, when those are not asked for, simulated from the commands.
Streams rotor_streams(const FlightArc& arc, const Vehicle& vehicle, std::span<const double> p, bool measured);

/// Changes of the rates, clipped, and of the integral of Omega^2 and of Omega of each column.
struct RotorWindows {
  Track3 rates;
  std::vector<Track> thrust, spin;
  std::size_t count() const { return thrust[0].size(); }
};

/// Windows over `lag` s, the rates shifted by that share of the margin.
RotorWindows rotor_windows(const std::vector<Streams>& arcs, double interval, double lag, double shift);

/// Correlation of the rate about each axis (row) with the moment about each (column) of rotors driven in that
/// order.
Eigen::Matrix3d correlation_of(const RotorWindows& windows, const std::vector<RotorMoment>& rotors,
                               const RotorOrder& order);

/// Shares of the yaw that the rotors' drag and inertia explain, as they spin and the other way round.
/// Whatever that inertia is: in fast turns it does more than drag, a quarter of a turn ahead.
struct YawShares {
  double as_stated = 0, reversed = 0;
};
YawShares yaw_shares(const RotorWindows& windows, const std::vector<RotorMoment>& rotors,
                     const RotorOrder& order);

/// Spread of the whole thrust between windows over its mean.
double thrust_variation(const RotorWindows& windows, const std::vector<Streams>& arcs, double lag);

}  // namespace ident
