// The equations of MODEL.md along measured states.
#include "predict.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace field {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kStep = 0.005;        // s, of the prediction
constexpr double kVelocitySpan = 0.5;  // s
constexpr double kRateSpan = 0.1;      // s
constexpr double kSettle = 1.0;        // s at the start of a log in which motors are followed only

// The log on a grid of kStep.
struct Grid {
  std::vector<double> t;
  std::vector<std::vector<double>> Omega, dOmega;  // by time, then rotor
  std::vector<Quaterniond> q_WB;
  std::vector<Vector3d> v_W, w_B;
};

std::vector<Series> group(const Columns& log, const std::string& stem, size_t count, bool drop_repeats) {
  std::vector<Series> series;
  for (size_t i = 1; i <= count; ++i)
    series.push_back(samples_of(log, stem + std::to_string(i), drop_repeats));
  return series;
}

std::vector<Series> named(const Columns& log, std::initializer_list<const char*> names) {
  std::vector<Series> series;
  for (const char* name : names) series.push_back(samples_of(log, name, true));
  return series;
}

Vector3d at(const std::vector<Series>& s, double t) {
  return {s[0].interpolated(t), s[1].interpolated(t), s[2].interpolated(t)};
}

struct Attitude {
  explicit Attitude(const Columns& log) : euler(log.contains("phi")) {
    parts = euler ? named(log, {"phi", "theta", "psi"}) : named(log, {"qw", "qx", "qy", "qz"});
    if (!euler) return;
    Series& psi = parts[2];
    for (size_t i = 1; i < psi.x.size(); ++i)
      psi.x[i] = psi.x[i - 1] + std::remainder(psi.x[i] - psi.x[i - 1], 2 * std::numbers::pi);
  }
  Quaterniond operator()(double t) const {
    const auto part = [&](size_t i) { return parts[i].interpolated(t); };
    if (!euler) return Quaterniond(part(0), part(1), part(2), part(3)).normalized();
    return Eigen::AngleAxisd(part(2), Vector3d::UnitZ()) * Eigen::AngleAxisd(part(1), Vector3d::UnitY()) *
           Eigen::AngleAxisd(part(0), Vector3d::UnitX());
  }
  bool euler;
  std::vector<Series> parts;
};

// Omega'' + 2 zeta_m omega_m Omega' + omega_m^2 Omega = omega_m^2 (km delta + Omega_0) (V/V0)^n     [Phang
// 22]
class Motors {
 public:
  Motors(const StatedModel& model, const Columns& log) : model_(model) {
    const bool pulses = log.contains("u1");
    commands_ = group(log, pulses ? "u" : "delta", model.hubs.size(), false);
    if (pulses) {
      for (Series& s : commands_) {
        for (double& u : s.x) u = (u - model.command_min) / (model.command_max - model.command_min);
      }
    }
    if (log.contains("vbat") && model.has("battery_sag.n")) {
      voltage_ = samples_of(log, "vbat", true);
      reference_ = model.battery_voltage > 0 ? model.battery_voltage
                                             : *std::max_element(voltage_.x.begin(), voltage_.x.end());
    }
  }

  double target(size_t rotor, double t) const {
    const double delta = commands_[rotor].held(t - model_.get("dead_time"));
    const double gain =
        reference_ > 0 ? std::pow(voltage_.interpolated(t) / reference_, model_.get("battery_sag.n")) : 1;
    return (model_.get("km") * delta + model_.get("Omega_0")) * gain;
  }

  void follow(Grid& grid) const {
    const size_t count = commands_.size();
    const double w = model_.get("omega_m"), zeta = model_.get("zeta_m", 1);
    for (size_t i = 0; i < count; ++i) {
      double x = target(i, grid.t.front()), slope = 0;
      for (size_t k = 0; k < grid.t.size(); ++k) {
        grid.Omega[k][i] = x;
        grid.dOmega[k][i] = slope;
        const double goal = target(i, grid.t[k]);
        const double before = x;
        if (zeta > 3) {  // first order, lag 2 zeta_m/omega_m
          x = goal + (x - goal) * std::exp(-kStep * w / (2 * zeta));
          slope = (x - before) / kStep;
          continue;
        }
        constexpr int kParts = 10;
        for (int part = 0; part < kParts; ++part) {
          slope += kStep / kParts * (w * w * (goal - x) - 2 * zeta * w * slope);
          x += kStep / kParts * slope;
        }
      }
    }
  }

 private:
  const StatedModel& model_;
  std::vector<Series> commands_;
  Series voltage_;
  double reference_ = 0;
};

void measured_speeds(Grid& grid, const StatedModel& model, const Columns& log) {
  const auto series = group(log, "omega", model.hubs.size(), true);
  for (size_t k = 0; k < grid.t.size(); ++k) {
    for (size_t i = 0; i < series.size(); ++i) {
      grid.Omega[k][i] = series[i].interpolated(grid.t[k]);
      const double around = 0.01;
      grid.dOmega[k][i] =
          (series[i].interpolated(grid.t[k] + around) - series[i].interpolated(grid.t[k] - around)) /
          (2 * around);
    }
  }
}

Grid lay_out(const StatedModel& model, const Columns& log, RotorInput input) {
  Grid grid;
  const double end = log.at("t").back();
  for (double t = 0; t < end; t += kStep) grid.t.push_back(t);
  grid.Omega.assign(grid.t.size(), std::vector<double>(model.hubs.size()));
  grid.dOmega = grid.Omega;
  if (input == RotorInput::kSpeeds) {
    measured_speeds(grid, model, log);
  } else {
    Motors(model, log).follow(grid);
  }
  const Attitude attitude(log);
  const auto v = named(log, {"vx", "vy", "vz"}), w = named(log, {"p", "q", "r"});
  for (const double t : grid.t) {
    grid.q_WB.push_back(attitude(t));
    grid.v_W.push_back(at(v, t));
    grid.w_B.push_back(at(w, t));
  }
  return grid;
}

struct Wrench {
  Vector3d F = Vector3d::Zero(), M = Vector3d::Zero();
};

// Rotors and the effects that a file may state (MODEL.md and the table of effects); without gravity.
Wrench wrench(const StatedModel& model, const Grid& grid, size_t k, const Vector3d& v_W,
              const Vector3d& w_B) {
  const Vector3d wind(model.get("wind.north"), model.get("wind.east"), model.get("wind.down"));
  const Vector3d cg(model.get("cg_offset.x"), model.get("cg_offset.y"), model.get("cg_offset.z"));
  const Vector3d v_B = grid.q_WB[k].conjugate() * (v_W - wind), a(0, 0, -1);
  const double Jp = model.get("Jp") + model.get("gyroscopic.Jp");
  Wrench sum;
  for (size_t i = 0; i < model.hubs.size(); ++i) {
    const double Omega = grid.Omega[k][i], s = model.spins[i];
    const bool weak = std::lround(model.get("rotor_mismatch.rotor")) == static_cast<long>(i) + 1;
    const double ratio = weak ? model.get("rotor_mismatch.ratio", 1) : 1;
    const Vector3d r = model.hubs[i] - cg, u = v_B + w_B.cross(r);
    const Vector3d across(u.x(), u.y(), 0);
    const double T = ratio * model.get("kT") * Omega * Omega -
                     model.get("axial_inflow.kz") * Omega * u.dot(a) +
                     model.get("translational_lift.kh") * across.squaredNorm();
    const Vector3d f = T * a - model.get("rotor_drag.kd") * Omega * across;
    sum.F += f;
    sum.M += r.cross(f) + model.get("blade_flapping.kf") * Omega * u.cross(a) -
             s * ratio * model.get("kQ") * Omega * Omega * a;
    sum.M -= s * Jp * (grid.dOmega[k][i] * a + Omega * w_B.cross(a));
  }
  sum.F -= model.get("parasitic_drag.C") * v_B.norm() * v_B;
  return sum;
}

double velocity_error(const StatedModel& model, const Grid& grid, size_t from, size_t span) {
  Vector3d v = grid.v_W[from];
  for (size_t k = from; k < from + span; ++k) {
    const Vector3d f = wrench(model, grid, k, v, grid.w_B[k]).F / model.m;
    v += kStep * (grid.q_WB[k] * f + Vector3d(0, 0, model.gravity));
  }
  return (v - grid.v_W[from + span]).squaredNorm();
}

double rate_error(const StatedModel& model, const Grid& grid, size_t from, size_t span) {
  Eigen::Matrix3d J = Vector3d(model.get("Jxx"), model.get("Jyy"), model.get("Jzz")).asDiagonal();
  const auto off = [&](const char* name) {
    return model.get(name) + model.get(std::string("products_of_inertia.") + name);
  };
  J(0, 1) = J(1, 0) = off("Jxy");
  J(0, 2) = J(2, 0) = off("Jxz");
  J(1, 2) = J(2, 1) = off("Jyz");
  const Eigen::Matrix3d inverse = J.inverse();
  Vector3d w = grid.w_B[from];
  for (size_t k = from; k < from + span; ++k) {
    const Vector3d M = wrench(model, grid, k, grid.v_W[k], w).M;
    w += kStep * (inverse * (M - w.cross(J * w)));
  }
  return (w - grid.w_B[from + span]).squaredNorm();
}

}  // namespace

bool has_speeds(const Columns& log) { return log.contains("omega1"); }

PredictionErrors predict(const StatedModel& model, const Columns& log, RotorInput input) {
  const Grid grid = lay_out(model, log, input);
  const auto steps = [](double seconds) { return static_cast<size_t>(std::lround(seconds / kStep)); };
  PredictionErrors errors;
  for (size_t k = steps(kSettle); k + steps(kVelocitySpan) < grid.t.size(); k += steps(kWindowStep)) {
    errors.velocity.push_back(velocity_error(model, grid, k, steps(kVelocitySpan)));
    errors.rates.push_back(rate_error(model, grid, k, steps(kRateSpan)));
  }
  return errors;
}

}  // namespace field
