// The balance of all stretches fitted, under their noise and what rotors scatter by from flight to flight.
#include "ident/flight/trim/trim_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/effects/all_parameters.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInCommon = 1e-3;  // what all rotors have in common is the thrust constant
constexpr double kLeastNoise = 1e-4;
// Where nothing is stated: what the flight does not tell either stays where it starts.
constexpr double kNothingKnown = 1.0;

// Derivative of the unbalance over the thrust of each rotor.
MatrixXd ratio_slopes(const FlightRecord& record, const Trim& trim, const std::vector<double>& p) {
  constexpr double h = 1e-3;
  const auto rotors = static_cast<Index>(record.vehicle->rotors.size());
  MatrixXd A(trim.rows(), rotors);
  for (Index k = 0; k < rotors; ++k) {
    const auto at = static_cast<std::size_t>(find_parameter(rotor_ratio(k + 1))->index);
    std::vector<double> more = p, less = p;
    more[at] += h, less[at] -= h;
    A.col(k) = (unbalance(record, trim, more) - unbalance(record, trim, less)) / (2 * h);
  }
  return A;
}

MatrixXd covariance(const Trim& trim, const Eigen::Vector4d& noise, const MatrixXd& A,
                    const TrimScatter& scatter) {
  MatrixXd V = MatrixXd::Zero(trim.rows(), trim.rows());
  const MatrixXd S = (scatter.rotor * scatter.rotor * MatrixXd::Identity(A.cols(), A.cols())).array() +
                     scatter.level * scatter.level;
  for (std::size_t i = 0; i < trim.stretches.size(); ++i)
    for (std::size_t k = 0; k < trim.stretches.size(); ++k) {
      if (trim.stretches[i].log != trim.stretches[k].log) continue;
      const Index a = kTrimChannels * static_cast<Index>(i), b = kTrimChannels * static_cast<Index>(k);
      V.block<4, 4>(a, b) = A.middleRows<kTrimChannels>(a) * S * A.middleRows<kTrimChannels>(b).transpose();
      if (i == k) V.block<4, 4>(a, b).diagonal() += noise.cwiseAbs2();
    }
  return V;
}

// Calls with the first and the number of the stretches of each log.
template <class Each>
void for_logs(const Trim& trim, const Each& each) {
  for (std::size_t i = 0, end = 0; i < trim.stretches.size(); i = end) {
    while (end < trim.stretches.size() && trim.stretches[end].log == trim.stretches[i].log) ++end;
    each(static_cast<Index>(i), static_cast<Index>(end - i));
  }
}

// Stretches by column, about the mean of their log.
MatrixXd about_means(const Trim& trim, const VectorXd& y) {
  MatrixXd out = Eigen::Map<const MatrixXd>(y.data(), kTrimChannels, y.size() / kTrimChannels);
  for_logs(trim, [&](Index first, Index count) {
    auto own = out.middleCols(first, count);
    const Eigen::Vector4d mean = own.rowwise().mean();
    own.colwise() -= mean;
  });
  return out;
}

// Scatter of stretches about the mean of their log. A slow drift, of a battery that the model lacks, counts
// as noise: where it passed for information, the offset of the command would bend to follow it, and with it
// what the rotors' commands say of their thrust.
Eigen::Vector4d noise_of(const Trim& trim, const VectorXd& y) {
  const double degrees = static_cast<double>(trim.stretches.size()) - trim.logs;
  if (degrees < 1) return Eigen::Vector4d::Constant(kUsualScatter);
  return (about_means(trim, y).rowwise().squaredNorm() / degrees).cwiseSqrt().cwiseMax(kLeastNoise);
}

// Mean squares over what the flights leave likely, everything that the constants may be taken out. What all
// rotors gain or lose together, as by the state of the battery, says nothing of how unlike they are.
TrimScatter scatter_of(const Trim& trim, const VectorXd& y, const Eigen::Vector4d& noise, const MatrixXd& A,
                       const MatrixXd& open) {
  constexpr double kLeast = 1e-3, kMostFit = 0.3, kStep = 0.25, kStepOfLevel = 0.7;  // of logarithms
  std::vector<TrimScatter> all;
  std::vector<double> weight;
  for (double rotor = std::log(kLeast); rotor < std::log(kMostFit); rotor += kStep)
    for (double level = std::log(kLeast); level < std::log(kMostFit); level += kStepOfLevel) {
      all.push_back({std::exp(rotor), std::exp(level)});
      const Eigen::LLT<MatrixXd> llt(covariance(trim, noise, A, all.back()) + open);
      const double usual = rotor - std::log(kUsualScatter), usual_level = level - std::log(kUsualLevel);
      weight.push_back(-llt.matrixLLT().diagonal().array().log().sum() - 0.5 * y.dot(llt.solve(y)) -
                       0.5 * usual * usual - 0.5 * usual_level * usual_level);
    }
  const double top = std::ranges::max(weight);
  double sum = 0;
  TrimScatter square;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double w = std::exp(weight[i] - top);
    sum += w, square.rotor += w * all[i].rotor * all[i].rotor,
        square.level += w * all[i].level * all[i].level;
  }
  return {std::sqrt(square.rotor / sum), std::sqrt(square.level / sum)};
}

// Direction of the unknowns in which all rotors gain alike: it is held, not to be told from the constant. One
// of which nothing is known stands apart from the others.
VectorXd in_common(const Theta& theta) {
  VectorXd all = VectorXd::Zero(theta.size());
  double rotors = 0;
  for (int i = 0; i < theta.constants_count(); ++i)
    if (const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
        is_rotor_ratio(c.name) && c.prior_std && *c.prior_std < 1)
      all[i] = c.unit(), rotors += 1;
  return all / (std::max(rotors, 1.0) * kInCommon);
}

}  // namespace

TrimFit fit_trim(const FlightRecord& record, const Trim& trim, const Theta& theta, bool hold_common,
                 const TrimFit* like) {
  constexpr int kSteps = 6;
  const bool scatter_known = states_rotor_ratios(*record.vehicle);
  TrimFit out;
  if (like) out.V = like->V, out.noise = like->noise, out.scatter = like->scatter;
  const VectorXd common = hold_common ? in_common(theta) : VectorXd::Zero(theta.size());
  VectorXd u = VectorXd::Zero(theta.size());
  MatrixXd H;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<double> p = theta.p(u);
    out.y = unbalance(record, trim, p);
    const MatrixXd Y = trim_slopes(record, trim, theta, u);
    const PriorTerms prior = theta.prior(u);
    MatrixXd known = common * common.transpose();
    known += prior.information();
    known.diagonal() += prior.slope.unaryExpr([](double s) { return s == 0 ? kNothingKnown : 0.0; });
    // Scatter is found where the constants stand at first: what they explain then is not yet taken out.
    if (step < 2 && !like) {
      const MatrixXd A = ratio_slopes(record, trim, p);
      out.noise = noise_of(trim, out.y);
      const VectorXd priors = prior.gradient() + common * common.dot(u);
      const VectorXd expected = out.y - Y * Eigen::LDLT<MatrixXd>(known).solve(priors);
      out.scatter = scatter_known && trim.logs < 2  // it is in their deviations
                        ? TrimScatter{}
                        : scatter_of(trim, expected, out.noise, A,
                                     Y * Eigen::LDLT<MatrixXd>(known).solve(MatrixXd(Y.transpose())));
      out.V = covariance(trim, out.noise, A, out.scatter);
    }
    const Eigen::LLT<MatrixXd> V(out.V);
    const MatrixXd WY = V.solve(Y);
    out.fit.information = Y.transpose() * WY;
    H = out.fit.information + known;
    const VectorXd g = WY.transpose() * out.y + prior.gradient() + common * common.dot(u);
    const VectorXd du = -Eigen::LDLT<MatrixXd>(H).solve(g);
    out.fit.cost = out.y.dot(V.solve(out.y)) + prior.cost() + std::pow(common.dot(u), 2);
    double widest = 1.0;  // of a logarithm
    for (int i = 0; i < theta.constants_count(); ++i)
      if (theta.constants()[static_cast<std::size_t>(i)].positive) widest = std::max(widest, std::abs(du[i]));
    if (step + 1 < kSteps) u += du / widest;
  }
  out.fit.u = u;
  out.fit.covariance = Eigen::LDLT<MatrixXd>(H).solve(MatrixXd::Identity(H.rows(), H.cols()));
  out.fit.naive_covariance = out.fit.covariance;
  out.fit.converged = u.allFinite() && out.fit.covariance.allFinite();
  out.beyond =
      out.fit.cost - (out.noise.cwiseInverse().asDiagonal() * about_means(trim, out.y)).squaredNorm();
  if (!out.fit.converged)
    throw DataError("the balance of these flights cannot be fitted: no number comes of it");
  return out;
}

}  // namespace ident
