// Pole placement along each axis, attitude by quaternions, allocation with roll and pitch first.
#include "ident/model/controller.h"

#include <Eigen/QR>
#include <algorithm>
#include <numbers>

namespace ident {
namespace {

/// Coefficients of prod (s + pole)^2, constant term first.
std::vector<double> polynomial(std::span<const double> poles) {
  std::vector<double> c = {1.0};
  for (const double pole : poles)
    for (int twice = 0; twice < 2; ++twice) {
      c.insert(c.begin(), 0.0);
      for (std::size_t i = 0; i + 1 < c.size(); ++i) c[i] += pole * c[i + 1];
    }
  return c;
}

Vec3<double> rotation_vector(const Vec4<double>& q) {
  const Vec3<double> v(q[1], q[2], q[3]);
  const double s = v.norm(), c = std::abs(q[0]), sign = q[0] < 0 ? -1.0 : 1.0;
  return s < 1e-9 ? Vec3<double>(2.0 * sign * v) : Vec3<double>(sign * 2.0 * std::atan2(s, c) / s * v);
}

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

}  // namespace

Controller::Controller(const Plant& plant, const Trim& trim, double interval)
    : trim_(trim),
      hover_squares_(static_cast<Eigen::Index>(trim.Omega.size())),
      g_(plant.vehicle().g),
      km_(plant.constant(param::km)),
      offset_(plant.constant(param::Omega_0)),
      omega_m_(plant.constant(param::omega_m)),
      zeta_m_(plant.constant(param::zeta_m)) {
  for (std::size_t n = 0; n < trim.Omega.size(); ++n)
    hover_squares_[static_cast<Eigen::Index>(n)] = trim.Omega[n] * trim.Omega[n];
  inverse_ = trim.effect.completeOrthogonalDecomposition().pseudoInverse();
  choose_poles(plant.command_delay() + 1.5 * interval);
  // Half the lift that is left over for climbing, and half the yaw that hover leaves for turning.
  const double most = trim.Omega_most * trim.Omega_most;
  double lift = 1e9, yaw = 1e9;
  for (Eigen::Index n = 0; n < hover_squares_.size(); ++n) {
    const double left = std::min(most - hover_squares_[n], hover_squares_[n]);
    lift = std::min(lift, (most / hover_squares_[n] - 1.0) * g_);
    yaw = std::min(yaw, left / std::max(std::abs(inverse_(n, 2)), 1e-30));
  }
  agility_.lift_acceleration = std::min(0.4 * lift, 0.4 * g_);
  agility_.tilt_acceleration = std::min(0.4 * lift, 0.4 * g_);
  agility_.yaw_acceleration = std::min(0.35 * yaw, 10.0);
}

void Controller::choose_poles(double delay) {
  const double w = omega_m_;
  lead_ = w * delay < 0.3;
  const double lag = delay + (lead_ ? 0.0 : 2.0 * zeta_m_ / w);
  const double gentle = lead_ ? 0.3 * w : 0.12 * w * std::min(1.0, 2.0 * zeta_m_);
  const double p2 = std::min({0.3 / lag, gentle, 12.0});
  const double p1 = std::min(0.5 * p2, 2.0), py = std::min(0.7 * p2, 4.0), pz = std::min(0.6 * p2, 3.0);
  agility_.attitude_pole = p2, agility_.position_pole = p1, agility_.yaw_pole = py, agility_.lift_pole = pz;
  agility_.motor_bandwidth = w;
  if (lead_) {
    const std::vector<double> c = polynomial(std::vector<double>{p1, p2, w - p1 - p2});
    tilt_ = {c[4] / (w * w) - 1.0, c[3] / (w * w), c[2] / (w * w), c[1] / c[2], c[0] / c[2]};
    const std::vector<double> y = polynomial(std::vector<double>{py, w - py});
    yaw_ = {y[2] / (w * w) - 1.0, y[1] / (w * w), y[0] / (w * w), 0.0, 0.0};
    const std::vector<double> z = polynomial(std::vector<double>{pz, w - pz});
    lift_ = {z[2] / (w * w) - 1.0, 0.0, 0.0, z[1] / (w * w), z[0] / (w * w)};
  } else {
    const std::vector<double> c = polynomial(std::vector<double>{p1, p2});
    tilt_ = {0.0, c[3], c[2], c[1] / c[2], c[0] / c[2]};
    yaw_ = {0.0, 2.0 * py, py * py, 0.0, 0.0};
    lift_ = {0.0, 0.0, 0.0, 2.0 * pz, pz * pz};
  }
}

// Specific force in the world that brings the vehicle to its setpoint.
Vec3<double> Controller::wanted_force(const BodyState<double>& body, const Setpoint& to, double interval) {
  const Vec3<double> far = limited(to.x_W - body.x_W, 3.0), fast = limited(to.v_W - body.v_W, 4.0);
  integral_ += interval * far;
  const double p1 = agility_.position_pole, pz = agility_.lift_pole;
  const Vec3<double> trail(integral_[0] * tilt_.position * p1 / 6, integral_[1] * tilt_.position * p1 / 6,
                           integral_[2] * lift_.position * pz / 6);
  Vec3<double> a = to.a_W + trail;
  for (int i = 0; i < 3; ++i) {
    const Gains& gains = i < 2 ? tilt_ : lift_;
    a[i] += gains.velocity * fast[i] + gains.position * far[i];
  }
  const Vec3<double> along = limited(Vec3<double>(a[0], a[1], 0), 1.6 * agility_.tilt_acceleration);
  const double climb = std::clamp(a[2], -1.8 * agility_.lift_acceleration, 0.5 * g_);
  return {along[0], along[1], climb - g_};
}

// Rotation vector to the attitude that points the lift along f_W at the wanted heading, and its rate.
Vec3<double> Controller::wanted_rotation(const BodyState<double>& body, const Setpoint& to,
                                         const Vec3<double>& f_W, Vec3<double>& rate_B) const {
  const auto attitude = [&](const Vec3<double>& force_W, double psi) {
    return quaternion_product(tilt_to(force_W.normalized()), quaternion_product(about_z(psi), trim_.q_WB));
  };
  const Vec3<double> g_W(0, 0, g_);
  const Vec4<double> now = attitude(to.a_W - g_W, to.psi), soon = attitude(to.a_soon_W - g_W, to.psi_soon);
  const Vec4<double> wanted = attitude(f_W, to.psi);
  const Vec4<double> error = quaternion_product(conjugate(body.q_WB), wanted);
  rate_B = rotation(error) * rotation_vector(quaternion_product(conjugate(now), soon)) / kAhead;
  return rotation_vector(error);
}

// Squared rotor speeds for angular accelerations and extra lift: roll and pitch first, then lift, then yaw.
Eigen::VectorXd Controller::allocated(const Eigen::Vector4d& wanted) const {
  const double least = trim_.Omega_least * trim_.Omega_least, most = trim_.Omega_most * trim_.Omega_most;
  Eigen::VectorXd tilt = inverse_.leftCols<2>() * wanted.head<2>();
  const Eigen::VectorXd turn = inverse_.col(2) * wanted[2];
  const double span = tilt.maxCoeff() - tilt.minCoeff();
  if (span > 0.9 * (most - least)) tilt *= 0.9 * (most - least) / span;
  const Eigen::VectorXd& lift = hover_squares_;
  double low = 0.0, high = 1e9;
  for (Eigen::Index n = 0; n < lift.size(); ++n) {
    low = std::max(low, (least - tilt[n]) / lift[n]);
    high = std::min(high, (most - tilt[n]) / lift[n]);
  }
  const double level = std::clamp(1.0 + wanted[3] / g_, std::min(low, high), high);
  Eigen::VectorXd squares = level * lift + tilt;
  double share = 1.0;
  for (Eigen::Index n = 0; n < lift.size(); ++n) {
    const double room = turn[n] > 0 ? most - squares[n] : squares[n] - least;
    if (std::abs(turn[n]) > 1e-30) share = std::min(share, std::max(room, 0.0) / std::abs(turn[n]));
  }
  squares += share * turn;
  return squares.cwiseMax(least).cwiseMin(most);
}

std::vector<double> Controller::command(const FlightState<double>& x, const Setpoint& to, double interval) {
  const Vec3<double> f_W = wanted_force(x.body, to, interval);
  Vec3<double> rate_B;
  const Vec3<double> error_B = wanted_rotation(x.body, to, f_W, rate_B);
  Eigen::VectorXd excess(hover_squares_.size());
  for (Eigen::Index n = 0; n < excess.size(); ++n) {
    const double Omega = x.motors[static_cast<std::size_t>(n)].Omega;
    excess[n] = Omega * Omega - hover_squares_[n];
  }
  const Eigen::Vector4d present = trim_.effect * excess;
  Eigen::Vector4d wanted;
  for (int i = 0; i < 3; ++i) {
    const Gains& gains = i < 2 ? tilt_ : yaw_;
    wanted[i] =
        gains.rate * (rate_B[i] - x.body.w_B[i]) + gains.angle * error_B[i] - gains.acceleration * present[i];
  }
  const Vec3<double> up_W = rotation(x.body.q_WB) * trim_.up_B;
  wanted[3] = std::max(f_W.dot(up_W), 0.3 * g_) - g_;
  wanted[3] -= lift_.acceleration * (present[3] + to.a_W[2]);  // the z axis points down
  const Eigen::VectorXd squares = allocated(wanted);
  std::vector<double> delta;
  for (Eigen::Index n = 0; n < squares.size(); ++n) {
    double Omega = std::sqrt(squares[n]);
    if (lead_) Omega += 2.0 * (zeta_m_ - 1.0) * x.motors[static_cast<std::size_t>(n)].Omega_dot / omega_m_;
    delta.push_back(std::clamp((Omega - offset_) / km_, 0.03, 1.0));
  }
  return delta;
}

}  // namespace ident
