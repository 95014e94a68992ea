// Quadratic forms made by hand.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/hypotheses/next_model.h"

namespace ident {

// One base constant, then causes over unknowns that know nothing of each other, each with the information `S`
// and its minimum at `at`.
inline Standing standing_by_hand(const std::vector<std::string>& names, const Eigen::VectorXd& S,
                                 const Eigen::VectorXd& at) {
  Standing out;
  for (const std::string& name : names) out.problem.constants.push_back({.name = name, .start = 0.0});
  out.problem.base = 1;
  const auto n = static_cast<Eigen::Index>(names.size());
  out.form.S = S.asDiagonal();
  out.form.g = -S.cwiseProduct(at);
  out.form.null = Eigen::VectorXd::Zero(n);
  out.form.prior = {Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Identity(n, n)};
  out.form.base = 1, out.form.constants = static_cast<int>(n);
  return out;
}

}  // namespace ident
