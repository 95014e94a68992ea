// The likelihood as a quadratic form over all causes at once.
#pragma once

#include "ident/gap/hypotheses/candidates.h"

namespace ident {

/// Unit of the height at which gusts push, as a share of the farthest that anything bolted on can be.
inline constexpr double kGustArm = 0.1;

/// cost(d) = cost0 + 2 g'd + d'S d over the extended unknowns d (after the constants gyro biases, and how far
/// above the origin gusts push), priors of the base not included.
struct QuadraticForm {
  double cost0 = 0.0;
  Eigen::VectorXd g, null;  ///< null: step that takes an adopted effect back to its null value
  PriorTerms prior;         ///< of the constants, and of what else is free
  Eigen::MatrixXd S;
  Eigen::MatrixXd scores;                    ///< [constant][block], base projected out
  std::vector<Eigen::MatrixXd> information;  ///< of each block, constants x constants, base projected out
  NoiseModel noise;  ///< what is left when every cause is free: the floor under which all are compared
  int base = 0, constants = 0;
};

/// Linearises everything at a fit. The first `problem.base` constants must be those of the fit, at its
/// values. The process noise is found anew with every cause free: with a cause missing its work would be
/// taken for gusts, and no test could see it.
QuadraticForm linearise_everything(const FlightRecord& record, const FlightFit& fit, const Theta& fitted,
                                   const ExtendedProblem& problem);

/// Unknowns of a model with no cause in it: constants that no effect brought, gyro biases, the gusts' height.
std::vector<int> base_unknowns(const QuadraticForm& form, const ExtendedProblem& problem);

/// Scores of blocks of time and their information, each projected on the base: what is left of them by
/// coloured residuals is wider than white ones would make it. Few blocks tell no variance: then nothing.
void add_blocks(QuadraticForm& form, const std::vector<ScoreBlock>& blocks, const std::vector<int>& base);

/// By how much coloured residuals, or a size that changes from block to block, inflate what these directions
/// gain: variance of their block scores, less the best common size, over what white residuals would give; 1
/// or more.
double stretch_of(const QuadraticForm& form, const std::vector<int>& directions);

}  // namespace ident
