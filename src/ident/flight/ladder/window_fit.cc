// Gauss-Newton steps with the derivatives of the model by differences, held within limits.
#include "ident/flight/ladder/window_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "ident/core/parallel.h"
#include "ident/core/statistics.h"
#include "ident/flight/ladder/constant_limits.h"
#include "ident/flight/ladder/error_by_speed.h"
#include "ident/flight/ladder/window_residuals.h"

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBlockFit = 2.0;  // s over which residuals are taken for related
// Slopes are taken anew where a step missed what they promised by more than this share of it: forces are
// nearly linear in all constants.
constexpr double kBent = 0.05;
constexpr int kSteps = 6;        // most Gauss-Newton steps; the model is nearly linear
constexpr double kStill = 1e-3;  // of a unit: no step worth another
constexpr double kApart = 1e-3;  // of a unit, for differences
// s: rates come late against what turns the vehicle by the filter of the gyro (0.23/f_c of second order at
// f_c: 2 to 7 ms) and by motors that are not as fast as stated. Unknown, it would pass for inertia.
constexpr double kLate = 0.01;
constexpr double kLatest = 3.0;  // times that

// What windows miss for some constants, and how that changes with one of them.
class Misses {
 public:
  Misses(const MeasuredMotion& motion, const std::vector<Window>& windows, FitTo what,
         std::span<const double> p)
      : motion_(motion), windows_(windows), what_(what) {
    if (what != FitTo::speeds) model_ = model_along(motion, p);
    here = what == FitTo::speeds ? missed_by(motion, windows, what, p)
                                 : missed_in(motion, windows, what, model_);
  }

  /// After the constant at `moved` alone changed.
  VectorXd after(int moved, std::span<const double> p) const {
    if (what_ == FitTo::speeds) return missed_by(motion_, windows_, what_, p);
    return missed_in(motion_, windows_, what_, model_along(motion_, p, model_, moved));
  }

  VectorXd by_late_rates() const { return missed_by_late_rates(motion_, windows_, model_); }

  MatrixXd slopes(const Theta& theta, const VectorXd& u) const {
    MatrixXd J(here.size(), u.size());
    in_parallel(static_cast<std::size_t>(u.size()), [&](std::size_t i) {
      const auto k = static_cast<Eigen::Index>(i);
      VectorXd moved = u;
      moved[k] += kApart;
      J.col(k) = (after(theta.constants()[i].index, theta.p(moved)) - here) / kApart;
    });
    return J;
  }

  VectorXd here;

 private:
  const MeasuredMotion& motion_;
  const std::vector<Window>& windows_;
  FitTo what_;
  std::vector<ModelAlong> model_;
};

// How much more the score of each unknown varies from block to block than independent windows would have it.
VectorXd colour(const std::vector<Window>& windows, const MatrixXd& J, const VectorXd& weighted,
                const VectorXd& information) {
  std::map<std::pair<std::size_t, long>, VectorXd> blocks;
  const Eigen::Index each = J.rows() / std::max<Eigen::Index>(std::ssize(windows), 1);
  for (std::size_t w = 0; w < windows.size(); ++w) {
    VectorXd& score = blocks[{windows[w].arc, std::lround(std::floor(windows[w].t / kBlockFit))}];
    if (score.size() == 0) score = VectorXd::Zero(J.cols());
    const auto at = each * static_cast<Eigen::Index>(w);
    score += J.middleRows(at, each).transpose() * weighted.segment(at, each);
  }
  VectorXd sum = VectorXd::Zero(J.cols());
  for (const auto& [block, score] : blocks) sum += score.cwiseAbs2();
  return sum.cwiseQuotient(information.cwiseMax(1e-300)).cwiseMax(1.0);
}

// What was known, and for the rest that a vehicle has it within its limits.
struct Stated {
  MatrixXd information;
  VectorXd gradient;
};
Stated stated(const Theta& theta, const VectorXd& x) {
  const Eigen::Index n = theta.size();
  const VectorXd u = x.head(n);
  const PriorTerms prior = theta.prior(u).extended(x.size());
  Stated out{prior.information(), prior.gradient()};
  out.gradient.tail(x.size() - n) = x.tail(x.size() - n);
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    if (c.prior_std) continue;
    const double s = spread_without_prior(c);
    out.information(i, i) += 1 / (s * s), out.gradient[i] += u[i] / (s * s);
  }
  return out;
}

// The step of the normal equations that keeps to the limits: what would leave them stops there.
VectorXd step_within(const MatrixXd& A, const VectorXd& b, const VectorXd& u,
                     const std::vector<std::array<double, 2>>& limits, std::vector<bool>& at_limit) {
  const auto n = u.size();
  VectorXd step = VectorXd::Zero(n);
  at_limit.assign(static_cast<std::size_t>(n), false);
  for (Eigen::Index round = 0; round <= n; ++round) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!at_limit[static_cast<std::size_t>(i)]) free.push_back(i);
    if (free.empty()) break;
    VectorXd rest = b;
    for (Eigen::Index i = 0; i < n; ++i)
      if (at_limit[static_cast<std::size_t>(i)]) rest -= A.col(i) * step[i];
    const VectorXd some = MatrixXd(A(free, free)).ldlt().solve(VectorXd(rest(free)));
    bool held = false;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const Eigen::Index i = free[k];
      const auto [low, high] = limits[static_cast<std::size_t>(i)];
      step[i] = some[static_cast<Eigen::Index>(k)];
      if (u[i] + step[i] >= low && u[i] + step[i] <= high) continue;
      step[i] = std::clamp(u[i] + step[i], low, high) - u[i];
      at_limit[static_cast<std::size_t>(i)] = held = true;
    }
    if (!held) break;
  }
  return step;
}

// Where these constants are, within their limits.
VectorXd place_of(const Theta& theta, const std::vector<double>& p,
                  const std::vector<std::array<double, 2>>& limits) {
  VectorXd u(theta.size());
  for (int i = 0; i < theta.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const FreeConstant& c = theta.constants()[k];
    const double value = p[static_cast<std::size_t>(c.index)];
    u[i] = c.positive ? std::log(value / c.start) : (value - c.start) / c.scale;
    u[i] = std::isfinite(u[i]) ? std::clamp(u[i], limits[k][0], limits[k][1]) : 0.0;
  }
  return u;
}

// What an error of the constants that are held makes of the estimate.
void add_held(WindowFit& fit, const MatrixXd& gain, const std::vector<HeldConstant>& held,
              const Misses& misses) {
  for (const HeldConstant& constant : held) {
    std::vector<double> off = fit.p;
    off[static_cast<std::size_t>(constant.index)] += constant.std;
    const VectorXd moved = gain * (misses.after(constant.index, off) - misses.here);
    if (moved.allFinite()) fit.covariance += moved * moved.transpose();
  }
}

}  // namespace

WindowFit fit_windows(const MeasuredMotion& motion, const Theta& theta, FitTo what,
                      const std::vector<HeldConstant>& held, const std::vector<double>& from) {
  const std::vector<Window> windows = windows_of(motion, what);
  const Eigen::Index n = theta.size(), beside = what == FitTo::moments ? 1 : 0;  // how late rates come
  std::vector<std::array<double, 2>> limits;
  for (const FreeConstant& c : theta.constants()) limits.push_back(limits_of(c));
  for (Eigen::Index i = 0; i < beside; ++i) limits.push_back({-kLatest, kLatest});
  WindowFit fit;
  fit.windows = windows.size();
  VectorXd x = VectorXd::Zero(n + beside), promised, before;
  x.head(n) = place_of(theta, from, limits);
  MatrixXd J, gain, covariance;  // gain: of the estimate over the residuals
  for (int round = 0; round < kSteps; ++round) {
    fit.u = x.head(n);
    const Misses misses(motion, windows, what, theta.p(fit.u));
    const bool bent = round > 0 && (misses.here - promised).norm() > kBent * (promised - before).norm();
    if (round == 0 || bent) {
      J = misses.slopes(theta, fit.u);
      J.conservativeResize(Eigen::NoChange, x.size());
      if (beside > 0) J.col(n) = kLate * misses.by_late_rates();
    }
    const VectorXd r = misses.here + J.rightCols(beside) * x.tail(beside);
    const Stated prior = stated(theta, x);
    const auto gain_by = [&](const VectorXd& weight) {
      const MatrixXd H = J.transpose() * weight.asDiagonal() * J;
      return MatrixXd((H + 1e-9 * MatrixXd(H.diagonal().asDiagonal()) + 1e-12 * prior.information)
                          .ldlt()
                          .solve(MatrixXd(J.transpose() * weight.asDiagonal())));
    };
    // Weights and colour are of what is missed with these constants at the data's own optimum, wherever the
    // search stands: of what a constant still explains they would make noise, and distrust the data that tell
    // it.
    const VectorXd weight = weight_by_speed(windows, r - J * (gain_by(weight_by_speed(windows, r)) * r));
    const MatrixXd own = gain_by(weight);
    const MatrixXd H = J.transpose() * weight.asDiagonal() * J;
    const VectorXd missed = weight.cwiseProduct(r - J * (own * r));
    const VectorXd factor = colour(windows, J, missed, H.diagonal()).cwiseSqrt().cwiseInverse();
    // The data's own step under that information, so that colour moves the weight against priors only.
    const MatrixXd data = factor.asDiagonal() * H * factor.asDiagonal();
    const MatrixXd A = data + prior.information;
    const VectorXd step = step_within(A, -(data * (own * r)) - prior.gradient, x, limits, fit.at_limit);
    before = misses.here, promised = before + J.leftCols(n) * step.head(n);
    x += step;
    gain = A.ldlt().solve(data * own);
    covariance = A.ldlt().solve(MatrixXd::Identity(A.rows(), A.cols()));
    if (step.cwiseAbs().maxCoeff() < kStill) break;
  }
  fit.u = x.head(n), fit.covariance = covariance.topLeftCorner(n, n);
  gain = gain.topRows(n).eval(), fit.at_limit.resize(static_cast<std::size_t>(n));
  fit.p = theta.p(fit.u);
  if (what == FitTo::speeds)
    for (const VectorXd& error : usual_errors_of_speeds(motion, windows, fit.p)) {
      const VectorXd moved = gain * error;
      if (moved.allFinite()) fit.covariance += moved * moved.transpose();
    }
  add_held(fit, gain, held, Misses(motion, windows, what, fit.p));
  return fit;
}

}  // namespace ident
