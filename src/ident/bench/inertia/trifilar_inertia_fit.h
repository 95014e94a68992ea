// The fit of the inertias to the swings of a pendulum.
#pragma once

#include <vector>

#include "ident/bench/inertia/trifilar_inertia_rows.h"
#include "ident/lsq/least_squares.h"
#include "ident/model/trifilar_period.h"
#include "ident/result/result.h"

namespace ident {

/// A pendulum's rows as equations. With m = m_v + m_p, d the offset and c = m_v d/m,
///
///     period = T( J_axis + J_platform + (m_v m_p/m) d^2 ;  r^2 = R^2 - c^2 )                          (1)
///
/// Without rows of the empty platform the vehicle hangs alone: m_p = 0, J_platform = 0.
class PendulumModel {
 public:
  PendulumModel(std::vector<PendulumRow> rows, double gravity);

  const std::vector<PendulumRow>& rows() const { return rows_; }
  bool has_axis(PendulumAxis axis) const { return count(axis) > 0; }
  std::size_t count(PendulumAxis axis) const;
  double platform_mass() const { return platform_mass_; }

  /// Unknowns in the order x, y, z, platform, as far as they have rows.
  static const char* name(PendulumAxis axis);

  TrifilarSuspension suspension(const PendulumRow& row) const;
  /// Inertia of all that hangs, x as in the fit.
  double hanging_inertia(const PendulumRow& row, const Eigen::VectorXd& x) const;

  LeastSquaresFit fit(std::vector<Warning>& warnings) const;

 private:
  enum class Grouping { pooled, by_axis };
  LeastSquaresProblem problem(Grouping grouping, bool trust_stated) const;
  Eigen::Index place(PendulumAxis axis) const;
  double parallel_axis(const PendulumRow& row) const;
  double linear_start(PendulumAxis axis) const;

  std::vector<PendulumRow> rows_;
  double gravity_, platform_mass_ = 0.0;
};

}  // namespace ident
