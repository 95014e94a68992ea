// Means of the features over each window, in body axes; ridge regression part by part.
#include "ident/gap/windows/window_rival.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStretch = 4.0;  // s
constexpr int kParts = 5;
constexpr Index kFeatures = 16;
constexpr double kRidge = 1.0;  // prior deviation of a feature's weight: what is missed itself

VectorXd features(const MeasuredArc& arc, std::size_t i, double thrust) {
  const BodyState<double>& body = arc.body[i];
  const Vec3<double> v = rotation(body.q_WB).transpose() * body.v_W;
  const std::vector<double>& ratio = arc.arc->inputs->voltage_ratio;
  const double voltage = ratio.empty() ? 1.0 : ratio[std::min(arc.row[i], ratio.size() - 1)];
  const double height = body.x_W[2];
  VectorXd out(kFeatures);
  out << v, v.norm() * v, thrust * v, body.w_B, v.head<2>().squaredNorm(), thrust, height * height, voltage;
  return out;
}

MatrixXd table_of(const WindowModel& model, const std::vector<ModelAlong>& along) {
  MatrixXd out(static_cast<Index>(model.windows().size()), kFeatures);
  for (std::size_t w = 0; w < model.windows().size(); ++w) {
    const Window& window = model.windows()[w];
    const MeasuredArc& arc = model.motion().arcs[window.arc];
    const std::vector<Vec3<double>>& gained = along[window.arc].gained_W;
    VectorXd sum = VectorXd::Zero(kFeatures);
    for (std::size_t i = window.begin + 1; i <= window.end; ++i)
      sum += features(arc, i, (gained[i] - gained[i - 1]).norm() / (arc.t[i] - arc.t[i - 1]));
    out.row(static_cast<Index>(w)) = sum.transpose() / static_cast<double>(window.end - window.begin);
  }
  for (Index f = 0; f < kFeatures; ++f) {
    VectorXd x = out.col(f).array() - out.col(f).mean();
    const double scale = std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
    out.col(f) = scale > 1e-9 ? VectorXd(x / scale) : VectorXd::Zero(x.size());
  }
  return out;
}

// Fall of the cost on the parts that were not fitted.
double gain_of(const MatrixXd& X, const VectorXd& y, const VectorXd& weight, const std::vector<int>& fold) {
  const Index n = X.cols();
  std::vector<MatrixXd> H(kParts, MatrixXd::Zero(n, n));
  std::vector<VectorXd> g(kParts, VectorXd::Zero(n));
  for (Index w = 0; w < y.size(); ++w) {
    const auto f = static_cast<std::size_t>(fold[static_cast<std::size_t>(w)]);
    H[f] += weight[w] * X.row(w).transpose() * X.row(w);
    g[f] += weight[w] * y[w] * X.row(w).transpose();
  }
  const double size = std::sqrt(std::max(y.squaredNorm() / static_cast<double>(y.size()), 1e-300));
  double gain = 0;
  for (std::size_t f = 0; f < kParts; ++f) {
    MatrixXd A = MatrixXd::Identity(n, n) * (kRidge / (size * size));
    VectorXd b = VectorXd::Zero(n);
    for (std::size_t other = 0; other < kParts; ++other)
      if (other != f) A += H[other], b += g[other];
    const VectorXd x = A.ldlt().solve(b);
    gain += 2 * g[f].dot(x) - x.dot(H[f] * x);
  }
  return gain;
}

}  // namespace

Rival window_rival(const WindowModel& model, const WindowStanding& standing) {
  Rival out{.judged = true};
  const Theta& theta = *standing.at.model.theta;
  const MatrixXd X = table_of(model, model_along(model.motion(), theta.p(standing.at.model.fit.u)));
  const ResidualWrench missed = wrench_of(model, standing);
  // Weights are those of what is missed, m/s or rad/s.
  VectorXd weight(X.rows());
  std::vector<int> part;
  for (Index w = 0; w < X.rows(); ++w) {
    weight[w] = standing.misses.weight[3 * w];
    part.push_back(
        static_cast<int>(std::lround(std::floor(missed.t[static_cast<std::size_t>(w)] / kStretch))) % kParts);
  }
  const std::vector<double> p = theta.p(standing.at.model.fit.u);
  const bool forces = model.what() == FitTo::forces;
  const Vec3<double> inertia(p[param::Jxx], p[param::Jyy], p[param::Jzz]);
  for (Index axis = 0; axis < 3; ++axis) {
    const double unit = forces ? p[param::m] : inertia[axis];
    out.gain[static_cast<std::size_t>(axis + (forces ? 0 : 3))] =
        gain_of(X, missed.residual.col(axis) * (horizon_of(model.what()) / unit), weight, part);
  }
  return out;
}

}  // namespace ident
