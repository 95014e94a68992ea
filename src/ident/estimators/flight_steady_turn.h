// What turns a vehicle in the mean of its flight. Gusts do not: weight or thrust lies elsewhere than the
// model has it, or rotors are unlike each other.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "ident/core/result.h"
#include "ident/estimators/flight_fit.h"

namespace ident {

/// Mean moment from outside about the axes of the body, N m, and how far gusts as strong as those that were
/// found may take it.
struct SteadyTurn {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), std = Eigen::Vector3d::Zero();
  Eigen::Vector3d matters = Eigen::Vector3d::Zero();  ///< smaller ones every vehicle has
  std::optional<int> log;                             ///< of this one; over all logs without

  /// Times what matters and what chance may make of it, of the axis where that is most.
  double times() const;
};

/// Over all logs, or in that one where it stands out most if that is more.
SteadyTurn steady_turn(const FlightRecord& record, const Theta& theta, const FlightFit& fit);

/// Warns of a moment that matters, in terms of what may be behind it.
void warn_of_steady_turn(Result& result, const SteadyTurn& turn, const Vehicle& vehicle,
                         std::span<const double> p, std::span<const FlightLog> logs);

}  // namespace ident
