// The rival's equations of motion with the catalogue's terms, evaluated at the measured states.
#include "rival_model.h"

#include <algorithm>
#include <cmath>

namespace rival {

Model::Model(const VehicleFile& vehicle, const std::vector<Log>& logs) : vehicle_(vehicle), logs_(logs) {
  double lift = 0;
  for (const Rotor& rotor : vehicle.rotors) lift -= rotor.a.z();
  hover_ = std::sqrt(vehicle.value.at("m") * vehicle.gravity / (vehicle.value.at("kT") * lift));
  voltage_ = logs.front().blocks.front().voltage;
  list_parameters();
}

Terms Model::terms(std::size_t log, const VectorXd& theta) const {
  const auto one = [&](const std::string& key) { return theta[index_.at(key)]; };
  const auto three = [&](const std::string& key) { return Vector3d(theta.segment<3>(index_.at(key))); };
  Terms x;
  x.kT = one("kT"), x.kQ = one("kQ"), x.km = one("km"), x.omega_m = one("omega_m"), x.zeta_m = one("zeta_m");
  x.delay = one("motor_delay.tau"), x.sag = one("battery_sag.n"), x.slow = one("motor_asymmetry.slow");
  x.kd = one("rotor_drag.kd"), x.kz = one("axial_inflow.kz"), x.kh = one("translational_lift.kh");
  x.kf = one("blade_flapping.kf"), x.C = one("parasitic_drag.C"), x.ground = one("ground_effect.radius2");
  x.curve = one("thrust_curve.c"), x.Jp = one("gyroscopic.Jp"), x.tau = one("sensor_delay.tau");
  x.wind = three("wind.north"), x.bias = three("imu_bias.ax"), x.lever = three("imu_lever_arm.x");
  x.turn = three("imu_misalignment.x"), x.gyro_bias = three("bias_p" + std::to_string(log));
  for (int i = 0; i < 4; ++i) {
    const std::string number = std::to_string(i + 1);
    const double about_x = one("rotor_tilt.x") + one("rotor_tilt.x" + number);
    const double about_y = one("rotor_tilt.y") + one("rotor_tilt.y" + number);
    const Vector3d& a = vehicle_.rotors[static_cast<std::size_t>(i)].a;
    x.axis.col(i) = (a + Vector3d(about_x, about_y, 0).cross(a)).normalized();
    x.share[i] = 1 - one("rotor_mismatch.weak" + number);
  }
  const double m = one("m"), payload = one("payload.m");
  const Vector3d moved = three("payload.mx"), products = three("products_of_inertia.Jxy");
  x.m = m + payload;
  x.c = (m * three("cg_offset.x") + moved) / x.m;
  x.J = Vector3d(one("Jxx"), one("Jyy"), one("Jzz")).asDiagonal();
  x.J(0, 1) = x.J(1, 0) = products.x();
  x.J(0, 2) = x.J(2, 0) = products.y();
  x.J(1, 2) = x.J(2, 1) = products.z();
  if (payload > 1e-6 * m)
    x.J += (moved.squaredNorm() * Matrix3d::Identity() - moved * moved.transpose()) / payload;
  return x;
}

Spin Model::integrate(const Log& log, const Terms& x) const {
  Spin result;
  Four Omega = x.km * log.delta.front(), rate = Four::Zero(), sum = Four::Zero(), rate_sum = Four::Zero();
  std::size_t cursor = 0;
  for (std::size_t k = 0; k < log.t.size(); ++k) {
    sum += Omega;
    rate_sum += rate;
    if ((k + 1) % log.rows_per_block == 0) {
      result.Omega.push_back(sum / static_cast<double>(log.rows_per_block));
      result.dOmega.push_back(rate_sum / static_cast<double>(log.rows_per_block));
      sum.setZero();
      rate_sum.setZero();
    }
    if (k + 1 == log.t.size()) break;
    const double span = log.t[k + 1] - log.t[k];
    const int steps = std::max(2, static_cast<int>(std::ceil(span * std::max(500.0, 6 * x.omega_m))));
    const double h = span / steps;
    const std::size_t block = std::min(k / log.rows_per_block, log.blocks.size() - 1);
    const double gain = x.sag == 0 ? x.km : x.km * std::pow(log.blocks[block].voltage / voltage_, x.sag);
    for (int j = 0; j < steps; ++j) {
      const Four target =
          gain * log.command(log.t[k] + j * h - x.delay, log.t[k] + (j + 1) * h - x.delay, &cursor);
      const Four down = (target.array() < Omega.array()).cast<double>();
      const Eigen::Array4d w = x.omega_m * (1 - x.slow * down.array());
      const Eigen::Array4d pull = w * w * (target - Omega - 0.5 * h * rate).array(), drag = 2 * x.zeta_m * w;
      const Four next = ((rate.array() * (1 - 0.5 * h * drag) + h * pull) / (1 + 0.5 * h * drag)).matrix();
      Omega += 0.5 * h * (rate + next);
      rate = next;
    }
  }
  return result;
}

// Measured speeds are noisy, predicted ones are off: the prediction plus the mean difference over 0.3 s.
void Model::blend(const Log& log, Spin* spin) const {
  const std::size_t n = log.blocks.size(), half = static_cast<std::size_t>(0.15 / log.step());
  std::vector<Four> sums{Four::Zero()};
  for (std::size_t k = 0; k < n; ++k) sums.push_back(sums.back() + log.blocks[k].speed - spin->Omega[k]);
  spin->used = spin->Omega;
  for (std::size_t k = 0; k < n && log.has_speed; ++k) {
    const std::size_t from = k < half ? 0 : k - half, to = std::min(k + half + 1, n);
    spin->used[k] += (sums[to] - sums[from]) / static_cast<double>(to - from);
  }
}

const Spin& Model::spin(std::size_t log, const Terms& x) const {
  const std::vector<double> key = {
      x.km, x.omega_m, x.zeta_m, x.delay, x.sag, x.slow, static_cast<double>(log)};
  if (spins_.size() > 64) spins_.clear();
  const auto found = spins_.find(key);
  if (found != spins_.end()) return found->second;
  Spin spin = integrate(logs_[log], x);
  blend(logs_[log], &spin);
  return spins_.emplace(key, std::move(spin)).first->second;
}

Accelerations Model::accelerate(const Log& log, const Spin& spin, const Terms& x) const {
  const std::size_t n = log.blocks.size();
  const Matrix3d J_inverse = x.J.inverse();
  Accelerations result;
  for (std::size_t k = 0; k < n; ++k) {
    const Block& b = log.blocks[k];
    const Vector3d w = b.gyro - x.gyro_bias, v_air = b.q.conjugate() * (b.v - x.wind);
    const Four& Omega = spin.used[k];
    Vector3d F = -x.C * v_air.norm() * v_air, M = Vector3d::Zero();
    for (int i = 0; i < 4; ++i) {
      const Rotor& rotor = vehicle_.rotors[static_cast<std::size_t>(i)];
      const Vector3d a = x.axis.col(i), flow = v_air + w.cross(rotor.r);
      const double climb = flow.dot(a), speed = Omega[i];
      const Vector3d across = flow - climb * a;
      double T = x.share[i] * x.kT * speed * speed * (1 + x.curve * (speed / hover_ - 1));
      T += x.kh * across.squaredNorm() - x.kz * speed * climb;
      if (x.ground != 0) {
        const double z = std::max(-(b.p + b.q * rotor.r).z(), 0.5 * vehicle_.radius);
        T /= 1 - std::clamp(x.ground / (16 * z * z), -0.5, 0.5);
      }
      const Vector3d force = T * a - x.kd * speed * across;
      F += force;
      M += rotor.r.cross(force) - rotor.s * x.share[i] * x.kQ * speed * speed * a +
           x.kf * speed * flow.cross(a);
      M -= rotor.s * x.Jp * (spin.dOmega[k][i] * a + speed * w.cross(a));
    }
    const Vector3d dw = J_inverse * (M - x.c.cross(F) - w.cross(x.J * w));
    const Vector3d f = F / x.m - dw.cross(x.c) - w.cross(w.cross(x.c));
    const Vector3d at_imu = f + dw.cross(x.lever) + w.cross(w.cross(x.lever));
    result.f.push_back(f);
    result.dw.push_back(dw);
    result.shown.push_back(at_imu - x.turn.cross(at_imu) + x.bias);
  }
  return result;
}

}  // namespace rival
