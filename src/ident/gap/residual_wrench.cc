// Residual wrench from accelerometer residuals and from the accelerations that the smoother found.
#include "ident/gap/residual_wrench.h"

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

std::size_t samples(const std::vector<double>& residuals, std::size_t channel) {
  std::size_t count = 0;
  for (std::size_t i = channel; i < residuals.size(); i += kChannels) count += std::isfinite(residuals[i]);
  return count;
}

// Variance that white noise alone gives to an acceleration found over a piece of flight: that of a slope
// through `count` samples within h seconds, drawn towards zero by what the fit expects of accelerations.
double shown_by_noise(double white, double count, double h, double expected) {
  if (count < 2 || !(expected > 0)) return 0.0;
  const double slope = 12 * white * white / (count * h * h), trust = expected * expected;
  return slope * std::pow(trust / (trust + slope), 2);
}

// Variance with which two pieces of flight tell a rotor's acceleration between them, each its speed through
// `count` samples. What the smoother draws towards zero is measured against the whole of it: next to no noise
// of the motors' own would else let a thousandth of that pass for a gap.
double told_by_speeds(double white, double count, double h) {
  return count < 1 ? 0.0 : 2 * white * white / (count * h * h);
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
    const bool turns = x.outside.axes == GustAxes::body;
    const Eigen::Vector3d push_B = turns ? x.outside.v_dot : R.transpose() * x.outside.v_dot;
    const AirNoise& air = floor.in_log(arc.log);
    Eigen::Vector3d gusts;
    for (int i = 0; i < 3; ++i)
      gusts[i] = std::pow(air.v_dot[static_cast<std::size_t>(i)].sigma, 2) + smoother.input_error(at, 3 + i);
    const Eigen::Vector3d gusts_B =
        floor.axes == GustAxes::body ? gusts : Eigen::Vector3d(R.transpose().cwiseAbs2() * gusts);
    for (int c = 0; c < 3; ++c) {
      const auto cc = static_cast<std::size_t>(c);
      double sum = 0, count = 0;
      for (std::size_t i = 0; i < place.end - place.begin; ++i) {
        const double r = residuals[at][i * kChannels + kForce + cc];
        if (std::isfinite(r)) sum -= r * fit.noise.sigma[kForce + cc], count += 1;
      }
      out.residual(k, c) = m * (push_B[c] + (count > 0 ? sum / count : 0.0));
      const AirNoise& expected = fit.noise.in_log(arc.log);
      const double turned = smoother.input_error(at, c), pushed = smoother.input_error(at, 3 + c);
      const double white = floor.sigma[kForce + cc],
                   speeds = static_cast<double>(samples(residuals[at], kVelocity + cc));
      variance[c] += m * m *
                     (gusts_B[c] +
                      (count > 0 ? white * white / count
                                 : shown_by_noise(floor.sigma[kVelocity + cc], speeds, h,
                                                  std::hypot(expected.v_dot[cc].sigma, std::sqrt(pushed)))));
      const double gyro = static_cast<double>(samples(residuals[at], kGyro + cc));
      const double moved = shown_by_noise(floor.sigma[kGyro + cc], gyro, h,
                                          std::hypot(expected.w_dot[cc].sigma, std::sqrt(turned)));
      out.residual(k, 3 + c) = J[cc] * x.outside.w_dot_B[c];
      variance[3 + c] += J[cc] * J[cc] * (std::pow(air.w_dot[cc].sigma, 2) + turned + moved);
    }
    for (Index c = 0; rotors && c < N; ++c) {
      if (defects[at].size() > 0) out.residual(k, 6 + c) = -defects[at][layout.motors + c] / h;
      const auto channel = static_cast<std::size_t>(kRotorChannel + c);
      const double speeds = static_cast<double>(samples(residuals[at], channel));
      variance[6 + c] += floor.q_motor / h + told_by_speeds(floor.sigma[channel], speeds, h);
    }
    const Eigen::Vector3d v_B = R.transpose() * x.body.v_W, w = x.body.w_B;
    double total = 0;
    for (Index c = 0; c < N; ++c) {
      const double ratio = x.motors[static_cast<std::size_t>(c)].Omega / hover;
      total += ratio * ratio;
    }
    const double z = record.vehicle->ground_z - x.body.x_W[2];
    const double ratio =
        arc.inputs->voltage_ratio.empty() ? 1.0 : mean_over(place, arc.inputs->voltage_ratio);
    speed[k] = v_B.norm(), climb[k] = -x.body.v_W[2], tilt[k] = std::acos(std::clamp(R(2, 2), -1.0, 1.0));
    rates[k] = w.norm(), collective[k] = total / static_cast<double>(N), height[k] = z, voltage[k] = ratio;
  }
  out.noise = (variance / static_cast<double>(std::max<Index>(n, 1))).cwiseSqrt().cwiseMax(1e-12);
  if (motion) out.regimes = {{"airspeed", speed}, {"climb", climb}};
  if (layout.attitude >= 0) out.regimes.emplace_back("tilt", tilt);
  out.regimes.emplace_back("rates", rates);
  if (layout.motors >= 0) out.regimes.emplace_back("collective", collective);
  if (layout.x >= 0) out.regimes.emplace_back("height", height);
  if (record.signals.voltage) out.regimes.emplace_back("voltage", voltage);
  return out;
}

}  // namespace ident
