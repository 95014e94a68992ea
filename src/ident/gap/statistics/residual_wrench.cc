// Residual wrench from accelerometer residuals and from the accelerations that the smoother found.
#include "ident/gap/statistics/residual_wrench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ident/core/stage_times.h"

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

// Piece of flight by piece: the residual of each channel, what a perfect model would leave there, and where
// the vehicle was.
class WrenchRows {
 public:
  WrenchRows(const FlightRecord& record, const Theta& theta, const FlightFit& fit, const NoiseModel& floor)
      : record_(record),
        fit_(fit),
        floor_(floor),
        smoother_(*fit.smoother),
        p_(theta.p(fit.u)),
        residuals_(smoother_.residuals()),
        defects_(smoother_.defects()),
        rotors_(record.layout.motors >= 0 && record.signals.rotor_speeds ? record.layout.rotors : 0) {
    out_.names = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
    for (Index c = 0; c < rotors_; ++c) out_.names.push_back("rotor" + std::to_string(c + 1));
    const Index n = std::ssize(smoother_.chunks()), channels = 6 + rotors_;
    out_.residual = MatrixXd::Zero(n, channels);
    variance_ = VectorXd::Zero(channels);
    for (VectorXd* regime : {&airspeed_, &climb_, &tilt_, &rates_, &collective_, &height_, &voltage_})
      regime->resize(n);
  }

  ResidualWrench all() {
    const Index n = out_.residual.rows();
    for (Index k = 0; k < n; ++k) {
      const ChunkPlace& place = smoother_.chunks()[static_cast<std::size_t>(k)];
      const FlightArc& arc = record_.arcs[static_cast<std::size_t>(place.arc)];
      const double h = arc.t[place.end] - arc.t[place.begin];
      out_.t.push_back(arc.t[place.begin] + h / 2);
      out_.log.push_back(arc.log);
      add_body(k, arc.log, h);
      add_rotors(k, h);
      add_regimes(k, place, arc);
    }
    out_.noise = (variance_ / static_cast<double>(std::max<Index>(n, 1))).cwiseSqrt().cwiseMax(1e-12);
    const StateLayout& layout = record_.layout;
    if (layout.v >= 0) out_.regimes = {{"airspeed", airspeed_}, {"climb", climb_}};
    if (layout.attitude >= 0) out_.regimes.emplace_back("tilt", tilt_);
    out_.regimes.emplace_back("rates", rates_);
    if (layout.motors >= 0) out_.regimes.emplace_back("collective", collective_);
    if (layout.x >= 0) out_.regimes.emplace_back("height", height_);
    if (record_.signals.voltage) out_.regimes.emplace_back("voltage", voltage_);
    return std::move(out_);
  }

 private:
  // What the smoother took for accelerations from outside, and what the accelerometer shows beyond it.
  void add_body(Index k, int log, double h) {
    const auto at = static_cast<std::size_t>(k);
    const FlightState<double>& x = smoother_.states()[at];
    const Mat3<double> R = rotation(x.body.q_WB);
    const bool turns = x.outside.axes == GustAxes::body;
    const Eigen::Vector3d push_B = turns ? x.outside.v_dot : R.transpose() * x.outside.v_dot;
    const AirNoise &air = floor_.in_log(log), &expected = fit_.noise.in_log(log);
    Eigen::Vector3d gusts;
    for (int i = 0; i < 3; ++i)
      gusts[i] = std::pow(air.v_dot[static_cast<std::size_t>(i)].sigma, 2) + smoother_.input_error(at, 3 + i);
    const Eigen::Vector3d gusts_B =
        floor_.axes == GustAxes::body ? gusts : Eigen::Vector3d(R.transpose().cwiseAbs2() * gusts);
    const double m = p_[param::m];
    constexpr std::array<std::size_t, 3> kInertia{param::Jxx, param::Jyy, param::Jzz};
    for (int c = 0; c < 3; ++c) {
      const auto cc = static_cast<std::size_t>(c);
      double sum = 0, count = 0;
      for (std::size_t i = kForce + cc; i < residuals_[at].size(); i += kChannels) {
        const double r = residuals_[at][i];
        if (std::isfinite(r)) sum -= r * fit_.noise.sigma[kForce + cc], count += 1;
      }
      out_.residual(k, c) = m * (push_B[c] + (count > 0 ? sum / count : 0.0));
      const double turned = smoother_.input_error(at, c), pushed = smoother_.input_error(at, 3 + c);
      const double white = floor_.sigma[kForce + cc],
                   speeds = static_cast<double>(samples(residuals_[at], kVelocity + cc));
      variance_[c] += m * m *
                      (gusts_B[c] +
                       (count > 0 ? white * white / count
                                  : shown_by_noise(floor_.sigma[kVelocity + cc], speeds, h,
                                                   std::hypot(expected.v_dot[cc].sigma, std::sqrt(pushed)))));
      const double gyro = static_cast<double>(samples(residuals_[at], kGyro + cc));
      const double moved = shown_by_noise(floor_.sigma[kGyro + cc], gyro, h,
                                          std::hypot(expected.w_dot[cc].sigma, std::sqrt(turned)));
      const double J = p_[kInertia[cc]];
      out_.residual(k, 3 + c) = J * x.outside.w_dot_B[c];
      variance_[3 + c] += J * J * (std::pow(air.w_dot[cc].sigma, 2) + turned + moved);
    }
  }

  void add_rotors(Index k, double h) {
    const auto at = static_cast<std::size_t>(k);
    for (Index c = 0; c < rotors_; ++c) {
      if (defects_[at].size() > 0) out_.residual(k, 6 + c) = -defects_[at][record_.layout.motors + c] / h;
      const auto channel = static_cast<std::size_t>(kRotorChannel + c);
      const double speeds = static_cast<double>(samples(residuals_[at], channel));
      variance_[6 + c] += floor_.q_motor / h + told_by_speeds(floor_.sigma[channel], speeds, h);
    }
  }

  void add_regimes(Index k, const ChunkPlace& place, const FlightArc& arc) {
    const FlightState<double>& x = smoother_.states()[static_cast<std::size_t>(k)];
    const double N = record_.layout.rotors;
    const double hover = std::sqrt(p_[param::m] * record_.vehicle->g / (N * p_[param::kT]));
    double total = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(record_.layout.rotors); ++n)
      total += std::pow(x.motors[n].Omega / hover, 2);
    const Mat3<double> R = rotation(x.body.q_WB);
    const std::vector<double>& voltage = arc.inputs->voltage_ratio;
    airspeed_[k] = x.body.v_W.norm(), climb_[k] = -x.body.v_W[2];
    tilt_[k] = std::acos(std::clamp(R(2, 2), -1.0, 1.0));
    rates_[k] = x.body.w_B.norm(), collective_[k] = total / N;
    height_[k] = record_.vehicle->ground_z - x.body.x_W[2];
    voltage_[k] = voltage.empty() ? 1.0 : mean_over(place, voltage);
  }

  const FlightRecord& record_;
  const FlightFit& fit_;
  const NoiseModel& floor_;
  FlightSmoother& smoother_;
  const std::vector<double> p_;
  const std::vector<std::vector<double>> residuals_;
  const std::vector<VectorXd> defects_;
  const Index rotors_;
  ResidualWrench out_;
  VectorXd variance_;
  VectorXd airspeed_, climb_, tilt_, rates_, collective_, height_, voltage_;
};

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
  const Stage stage("what is left");
  return WrenchRows(record, theta, fit, floor).all();
}

}  // namespace ident
