// What turns a vehicle in the mean of its flight. Gusts do not: weight or thrust lies elsewhere than the
// model has it, or rotors are unlike each other.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// Mean moment from outside about the axes of the body, N m.
struct SteadyTurn {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d chance = Eigen::Vector3d::Zero();   ///< no more than this comes of gusts
  Eigen::Vector3d matters = Eigen::Vector3d::Zero();  ///< smaller ones every vehicle has; 0: unknown
  double weight = 0.0;                                ///< N, with what the model carries
  std::optional<int> log;                             ///< of this one; over all logs without

  /// Times what matters and what chance may make of it, about one axis; above 1 it stands out.
  double times(int axis) const;
  double times() const;  ///< of the axis where that is most
};

/// Over all logs, or in that one where it stands out most if that is more. None in less than 18 s.
SteadyTurn steady_turn(const FlightRecord& record, const Theta& theta, const FlightFit& fit);

/// Warns of a moment that stands out, in terms of what may be behind it.
void warn_of_steady_turn(Result& result, const SteadyTurn& turn, const FlightRecord& record,
                         std::span<const FlightLog> logs);

}  // namespace ident
