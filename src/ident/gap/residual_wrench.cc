// Residual wrench from accelerometer residuals and from the links' defects; generic regression as the rival.
#include "ident/gap/residual_wrench.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double mean_over(const ChunkPlace& place, const std::vector<double>& column) {
  double sum = 0;
  for (std::size_t i = place.begin; i < place.end; ++i) sum += column[i];
  return sum / static_cast<double>(place.end - place.begin);
}

}  // namespace

VectorXd ResidualWrench::rms() const {
  return (residual.cwiseAbs2().colwise().sum() / static_cast<double>(std::max<Index>(residual.rows(), 1)))
      .cwiseSqrt();
}

VectorXd ResidualWrench::excess() const {
  return (rms().cwiseQuotient(noise).cwiseAbs2().array() - 1).max(0.0);
}

ResidualWrench residual_wrench(const FlightRecord& record, const Theta& theta, const FlightFit& fit,
                               const NoiseModel& floor) {
  ResidualWrench out;
  FlightSmoother& smoother = *fit.smoother;
  const std::vector<double> p = theta.p(fit.u);
  const StateLayout& layout = record.layout;
  const auto& places = smoother.chunks();
  const auto residuals = smoother.residuals();
  const std::vector<Eigen::VectorXd> defects = smoother.defects();
  const std::vector<FlightState<double>>& states = smoother.states();
  const bool motion = layout.v >= 0, rotors = layout.motors >= 0 && record.signals.rotor_speeds;
  const Index n = static_cast<Index>(places.size()), N = layout.rotors;
  const Index channels = 6 + (rotors ? N : 0);
  out.names = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  for (Index k = 0; rotors && k < N; ++k) out.names.push_back("rotor" + std::to_string(k + 1));
  out.residual = MatrixXd::Zero(n, channels);
  VectorXd variance = VectorXd::Zero(channels);
  const double m = p[param::m],
               hover = std::sqrt(m * record.vehicle->g / (static_cast<double>(N) * p[param::kT]));
  const std::array<double, 3> J{p[param::Jxx], p[param::Jyy], p[param::Jzz]};
  std::vector<std::vector<double>> rows;
  VectorXd speed(n), climb(n), tilt(n), rates(n), collective(n), height(n), voltage(n);
  for (Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const ChunkPlace& place = places[at];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    const double h = arc.t[place.end] - arc.t[place.begin];
    const FlightState<double>& x = states[at];
    const Mat3<double> R = rotation(x.body.q_WB);
    out.t.push_back(arc.t[place.begin] + h / 2);
    out.log.push_back(arc.log);
    // What the smoother took for accelerations from outside, and what the accelerometer shows beyond it.
    const Eigen::Vector3d push_B = R.transpose() * x.outside.v_dot_W;
    for (int c = 0; c < 3; ++c) {
      const auto cc = static_cast<std::size_t>(c);
      double sum = 0, count = 0;
      for (std::size_t i = 0; i < place.end - place.begin; ++i) {
        const double r = residuals[at][i * kChannels + kForce + cc];
        if (std::isfinite(r)) sum -= r * fit.noise.sigma[kForce + cc], count += 1;
      }
      out.residual(k, c) = m * (push_B[c] + (count > 0 ? sum / count : 0.0));
      const double white = count > 0 ? floor.sigma[kForce + cc] : 0.0;
      variance[c] += m * m * (floor.v_dot.sigma * floor.v_dot.sigma + white * white / std::max(count, 1.0));
      out.residual(k, 3 + c) = J[cc] * x.outside.w_dot_B[c];
      variance[3 + c] += J[cc] * J[cc] * floor.w_dot.sigma * floor.w_dot.sigma;
    }
    for (Index c = 0; rotors && c < N; ++c) {
      if (defects[at].size() > 0) out.residual(k, 6 + c) = -defects[at][layout.motors + c];
      variance[6 + c] += floor.q_motor * h;
    }
    const Eigen::Vector3d v_B = R.transpose() * x.body.v_W, w = x.body.w_B;
    double total = 0;
    std::vector<double> f;
    for (int c = 0; c < 3; ++c) f.push_back(v_B[c]);
    for (int c = 0; c < 3; ++c) f.push_back(v_B[c] * v_B.norm());
    for (int c = 0; c < 3; ++c) f.push_back(w[c]);
    f.insert(f.end(), {w[0] * w[1], w[1] * w[2], w[2] * w[0], v_B.head<2>().squaredNorm()});
    for (Index c = 0; c < N; ++c) {
      const MotorState<double>& motor = x.motors[static_cast<std::size_t>(c)];
      const double ratio = motor.Omega / hover;
      total += ratio * ratio;
      f.push_back(ratio * ratio), f.push_back(motor.Omega_dot / hover);
    }
    for (int c = 0; c < 3; ++c) f.push_back(R(0, c)), f.push_back(R(1, c)), f.push_back(R(2, c));
    const double z = record.vehicle->ground_z - x.body.x_W[2];
    f.push_back(1.0 / (0.05 + std::max(z, 0.0) * std::max(z, 0.0)));
    const double ratio = arc.inputs.voltage_ratio.empty() ? 1.0 : mean_over(place, arc.inputs.voltage_ratio);
    f.push_back(ratio);
    f.push_back(out.t.back() - arc.inputs.t0);
    // Memory: velocity and rates of the two chunks before.
    for (std::size_t back = 1; back <= 2; ++back) {
      const bool there = at >= back && places[at - back].arc == place.arc;
      const FlightState<double>& y = there ? states[at - back] : x;
      for (int c = 0; c < 3; ++c) f.push_back(y.body.v_W[c]), f.push_back(y.body.w_B[c]);
    }
    rows.push_back(f);
    speed[k] = v_B.norm(), climb[k] = -x.body.v_W[2], tilt[k] = std::acos(std::clamp(R(2, 2), -1.0, 1.0));
    rates[k] = w.norm(), collective[k] = total / static_cast<double>(N), height[k] = z, voltage[k] = ratio;
  }
  out.noise = (variance / static_cast<double>(std::max<Index>(n, 1))).cwiseSqrt().cwiseMax(1e-12);
  out.features.resize(n, static_cast<Index>(rows.empty() ? 0 : rows[0].size()));
  for (Index k = 0; k < n; ++k)
    for (Index c = 0; c < out.features.cols(); ++c)
      out.features(k, c) = rows[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)];
  if (motion) out.regimes = {{"airspeed", speed}, {"climb", climb}};
  if (layout.attitude >= 0) out.regimes.emplace_back("tilt", tilt);
  out.regimes.emplace_back("rates", rates);
  if (layout.motors >= 0) out.regimes.emplace_back("collective", collective);
  if (layout.x >= 0) out.regimes.emplace_back("height", height);
  if (record.signals.voltage) out.regimes.emplace_back("voltage", voltage);
  return out;
}

VectorXd generic_rival(const ResidualWrench& wrench) {
  const Index n = wrench.residual.rows(), channels = wrench.residual.cols();
  VectorXd share = VectorXd::Zero(channels);
  if (n < 60) return share;
  MatrixXd X = wrench.features;
  for (Index c = 0; c < X.cols(); ++c) {
    X.col(c).array() -= X.col(c).mean();
    const double s = std::sqrt(X.col(c).squaredNorm() / static_cast<double>(n));
    X.col(c) /= std::max(s, 1e-12);
    if (s < 1e-12) X.col(c).setZero();
  }
  constexpr Index kFolds = 8;
  VectorXd error = VectorXd::Zero(channels), total = VectorXd::Zero(channels);
  const MatrixXd whole = X.transpose() * X, cross = X.transpose() * wrench.residual;
  for (Index fold = 0; fold < kFolds; ++fold) {
    // Blocks in time, interleaved: each fold leaves out two separate stretches.
    std::vector<Index> out_rows;
    for (Index k = 0; k < n; ++k)
      if (k * 2 * kFolds / n % kFolds == fold) out_rows.push_back(k);
    MatrixXd A = whole, B = cross;
    for (const Index k : out_rows) {
      A.noalias() -= X.row(k).transpose() * X.row(k);
      B.noalias() -= X.row(k).transpose() * wrench.residual.row(k);
    }
    A.diagonal().array() += 0.05 * static_cast<double>(n);
    const MatrixXd W = Eigen::LDLT<MatrixXd>(A).solve(B);
    for (const Index k : out_rows) {
      error += (wrench.residual.row(k) - X.row(k) * W).cwiseAbs2().transpose();
      total += wrench.residual.row(k).cwiseAbs2().transpose();
    }
  }
  for (Index c = 0; c < channels; ++c) share[c] = total[c] > 0 ? std::max(0.0, 1 - error[c] / total[c]) : 0.0;
  return share;
}

}  // namespace ident
