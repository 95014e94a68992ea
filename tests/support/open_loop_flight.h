// A small quadrotor flown open loop about hover, and chunks of that flight as tasks for the kernel.
#pragma once

#include "ident/flight/fit/fit.h"
#include "ident/flight/make_record.h"

namespace ident {

inline Vehicle small_quad() {
  Vehicle v;
  v.rotors = layout_rotors("plus", 0.17, 0.0);
  v.parameters = {{"m", {0.5, 0.001}},     {"kT", {6e-6, 2e-7}},      {"kQ", {1e-7, 5e-9}},
                  {"km", {900, 20.0}},     {"omega_m", {25, 2.0}},    {"zeta_m", {0.9, 0.1}},
                  {"Jxx", {3e-3, 1.5e-4}}, {"Jyy", {3.2e-3, 1.5e-4}}, {"Jzz", {5e-3, 2.5e-4}}};
  return v;
}

// Open loop about hover for 1.2 s: exact signals of all kinds.
inline FlightLog open_loop(const Vehicle& v, const std::vector<double>& p) {
  FlightLog log;
  const double hover = std::sqrt(0.5 * 9.81 / (4 * p[param::kT])) / p[param::km];
  log.delta.resize(4), log.Omega.resize(4);
  for (int i = 0; i <= 300; ++i) {
    log.t.push_back(0.004 * i);
    for (std::size_t n = 0; n < 4; ++n)
      log.delta[n].push_back(
          hover * (1 + 0.02 * std::sin(0.11 * i * static_cast<double>(n + 1) + static_cast<double>(n))));
  }
  FlightInputs inputs;
  for (const auto& column : log.delta) inputs.delta.emplace_back(log.t, column);
  const EffectSet<double> none(p, 0);
  Flight<double, EffectSet<double>> flight(v, p, none, inputs);
  FlightState<double> x;
  x.body = {Vec4<double>(1, 0, 0, 0), Vec3<double>::Zero(), Vec3<double>(1, 0.5, 0), Vec3<double>(0, 0, -2)};
  for (auto& motor : x.motors) motor = {hover * p[param::km], 0.0};
  for (std::size_t i = 0; i < log.t.size(); ++i) {
    const BodyRate<double> rate = flight.rate(x, log.t[i]);
    for (int k = 0; k < 3; ++k) {
      const auto c = static_cast<std::size_t>(k);
      log.w_B[c].push_back(x.body.w_B[k]), log.f_B[c].push_back(rate.f_B[k]);
      log.v_W[c].push_back(x.body.v_W[k]), log.x_W[c].push_back(x.body.x_W[k]);
    }
    for (int k = 0; k < 4; ++k)
      log.q_WB[static_cast<std::size_t>(k)].push_back(x.body.q_WB[k] / x.body.q_WB.norm());
    for (std::size_t n = 0; n < 4; ++n) log.Omega[n].push_back(x.motors[n].Omega);
    if (i + 1 < log.t.size()) x = flight.step(x, log.t[i], log.t[i + 1] - log.t[i], rate);
  }
  log.windows = {{0.0, 2.0}};
  return log;
}

struct Setting {
  Vehicle vehicle = small_quad();
  std::vector<double> p = parameter_vector(vehicle);
  std::vector<FlightLog> logs{open_loop(vehicle, p)};
  FlightRecord record = make_flight_record(vehicle, p, logs);
  Theta theta{p, free_constants(vehicle, p), 1, true};
  std::vector<Seed> seeds;
  std::array<double, kChannels> weight{};
  Eigen::VectorXd u;

  ChunkTask task(const Eigen::VectorXd& at, std::vector<double>& constants) {
    constants = theta.p(at);
    seeds = theta.seeds(at, 0);
    weight.fill(10.0);
    const FlightArc& arc = record.arcs[0];
    ChunkTask t;
    t.vehicle = &vehicle, t.inputs = arc.inputs.get(), t.layout = record.layout, t.p = constants,
    t.seeds = seeds;
    t.gyro_bias = theta.gyro_bias(at, 0);
    t.thetas = theta.size(), t.begin = 10, t.end = 120, t.rows = arc.rows();
    t.t = arc.t.data(), t.y = arc.y.data(), t.q = arc.q.data(), t.weight = weight.data();
    t.x0 = arc.start(10);
    t.x0.body.w_B[0] += 0.01;
    return t;
  }
};

}  // namespace ident
