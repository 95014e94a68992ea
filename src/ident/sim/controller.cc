// Flatness for the reference, a linear gain for the deviations, priorities for the limits.
#include "ident/sim/controller.h"

#include <Eigen/QR>
#include <algorithm>

namespace ident {
namespace {

constexpr double kLeastCommand = 0.03;

Vec4<double> about_z(double psi) { return {std::cos(psi / 2), 0, 0, std::sin(psi / 2)}; }

/// Shortest rotation from up (0,0,-1) to a direction.
Vec4<double> tilt_to(const Vec3<double>& direction_W) {
  const Vec3<double> up(0, 0, -1);
  const Vec3<double> axis = cross(up, direction_W);
  return Vec4<double>(1.0 + up.dot(direction_W), axis[0], axis[1], axis[2]).normalized();
}

Vec3<double> limited(const Vec3<double>& v, double most) {
  const double size = v.norm();
  return size > most ? Vec3<double>(v * (most / size)) : v;
}

Eigen::VectorXd as_vector(std::span<const double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

Controller::Controller(const Plant& plant, const Trim& trim, double height, double interval)
    : trim_(trim),
      model_(hover_model(plant, trim, height, interval)),
      gain_(regulator_gain(model_, static_cast<int>(trim.Omega.size()))),
      g_(plant.vehicle().g),
      km_(plant.constant(param::km)),
      offset_(plant.constant(param::Omega_0)),
      omega_m_(plant.constant(param::omega_m)),
      zeta_m_(plant.constant(param::zeta_m)) {
  effect_ = trim.effect * (2.0 * km_ * as_vector(trim.Omega)).asDiagonal();
  inverse_ = effect_.completeOrthogonalDecomposition().pseudoInverse();
  under_way_.assign(static_cast<std::size_t>(model_.delayed), as_vector(trim.delta));
  judge_agility(plant.command_delay() + 1.5 * interval);
}

void Controller::judge_agility(double delay) {
  const double lag = delay + 2.0 * std::max(zeta_m_, 0.5) / omega_m_;
  const double p = std::min(0.6 / lag, 12.0);
  agility_.attitude_bandwidth = p;
  agility_.position_bandwidth = std::min(0.4 * p, 2.0);
  agility_.yaw_bandwidth = std::min(0.5 * p, 4.0), agility_.lift_bandwidth = std::min(0.5 * p, 3.0);
  // Part of the lift that is left over for climbing, part of the yaw that hover leaves for turning.
  double lift = 1e9, yaw = 1e9;
  for (std::size_t n = 0; n < trim_.Omega.size(); ++n) {
    const double ratio = trim_.Omega_most / trim_.Omega[n];
    lift = std::min(lift, (ratio * ratio - 1.0) * g_);
    const double room = std::min(1.0 - trim_.delta[n], trim_.delta[n]);
    yaw = std::min(yaw, room / std::max(std::abs(inverse_(static_cast<Eigen::Index>(n), 2)), 1e-30));
  }
  agility_.lift_acceleration = agility_.tilt_acceleration = std::min(0.4 * lift, 0.4 * g_);
  agility_.yaw_acceleration = std::min(0.35 * yaw, 10.0);
}

// Attitude that points the lift along a - g at the wanted heading, and the rates to where it points soon.
Controller::Reference Controller::reference(const Setpoint& to) const {
  const Vec3<double> g_W(0, 0, g_);
  const auto attitude = [&](const Vec3<double>& a_W, double psi) {
    return quaternion_product(tilt_to(Vec3<double>(a_W - g_W).normalized()),
                              quaternion_product(about_z(psi), trim_.q_WB));
  };
  const Vec4<double> now = attitude(to.a_W, to.psi), soon = attitude(to.a_soon_W, to.psi_soon);
  return {now, rotation_vector_from_quaternion(quaternion_product(conjugate(now), soon)) / kAhead,
          (to.a_W - g_W).norm() / g_};
}

// The regulator's state: position and velocity in the heading frame, rotation, rates, motors, commands.
Eigen::VectorXd Controller::deviation(const FlightState<double>& x, const Setpoint& to,
                                      const Reference& reference) {
  const auto rotors = static_cast<Eigen::Index>(trim_.Omega.size());
  const Mat3<double> R_WH = rotation(about_z(to.psi));
  const Vec3<double> far = limited(x.body.x_W - to.x_W, 1.5);
  const Vec4<double> off = quaternion_product(conjugate(reference.q_WB), x.body.q_WB);
  Eigen::VectorXd z(model_.A.rows());
  z.segment<3>(0) = R_WH.transpose() * (far + trail_W_);
  z.segment<3>(3) = R_WH.transpose() * limited(x.body.v_W - to.v_W, 3.0);
  z.segment<3>(6) = rotation_vector_from_quaternion(off);
  z.segment<3>(9) = x.body.w_B - rotation(off).transpose() * reference.w_B;
  const double speed = std::sqrt(reference.level);
  Eigen::VectorXd expected(rotors);
  for (Eigen::Index n = 0; n < rotors; ++n) {
    const auto& motor = x.motors[static_cast<std::size_t>(n)];
    const double Omega = trim_.Omega[static_cast<std::size_t>(n)] * speed;
    expected[n] = (Omega - offset_) / km_;
    z[12 + n] = motor.Omega - Omega, z[12 + rotors + n] = motor.Omega_dot;
  }
  for (int k = 0; k < model_.delayed; ++k)
    z.segment(12 + (2 + k) * rotors, rotors) = under_way_[static_cast<std::size_t>(k)] - expected;
  return z;
}

// Keeps the commands within their range: gives up yaw first, then lift, roll and pitch last.
Eigen::VectorXd Controller::shed(const Eigen::VectorXd& base, const Eigen::VectorXd& change) const {
  const Eigen::Vector4d wanted = effect_ * change;
  Eigen::VectorXd tilt = inverse_.leftCols<2>() * wanted.head<2>();
  const Eigen::VectorXd turn = inverse_.col(2) * wanted[2], up = inverse_.col(3);
  const double span = tilt.maxCoeff() - tilt.minCoeff(), whole = 1.0 - kLeastCommand;
  if (span > 0.9 * whole) tilt *= 0.9 * whole / span;
  double low = -1e9, high = 1e9;
  for (Eigen::Index n = 0; n < base.size(); ++n) {
    const double at = base[n] + tilt[n];
    low = std::max(low, (kLeastCommand - at) / up[n]);
    high = std::min(high, (1.0 - at) / up[n]);
  }
  const double lift = low <= high ? std::clamp(wanted[3], low, high) : 0.5 * (low + high);
  Eigen::VectorXd delta = base + tilt + lift * up;
  double share = 1.0;
  for (Eigen::Index n = 0; n < base.size(); ++n) {
    const double room = turn[n] > 0 ? 1.0 - delta[n] : delta[n] - kLeastCommand;
    if (std::abs(turn[n]) > 1e-30) share = std::min(share, std::max(room, 0.0) / std::abs(turn[n]));
  }
  return (delta + share * turn).cwiseMax(kLeastCommand).cwiseMin(1.0);
}

std::vector<double> Controller::command(const FlightState<double>& x, const Setpoint& to, double interval) {
  // Slower than the regulator by a factor: it only takes off what wind and the battery leave over.
  trail_W_ += interval * 0.15 * agility_.position_bandwidth * limited(x.body.x_W - to.x_W, 1.0);
  trail_W_ = limited(trail_W_, 2.0);
  const Reference at = reference(to);
  const Eigen::VectorXd change = -gain_ * deviation(x, to, at);
  Eigen::VectorXd base(static_cast<Eigen::Index>(trim_.Omega.size()));
  for (Eigen::Index n = 0; n < base.size(); ++n)
    base[n] = (trim_.Omega[static_cast<std::size_t>(n)] * std::sqrt(at.level) - offset_) / km_;
  const Eigen::VectorXd delta = shed(base, change);
  return {delta.data(), delta.data() + delta.size()};
}

void Controller::given(std::span<const double> delta) {
  if (under_way_.empty()) return;
  under_way_.push_front(as_vector(delta));
  under_way_.pop_back();
}

}  // namespace ident
