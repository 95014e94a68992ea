// Generated motor steps, and the campaign of the motor estimator on them.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "ident/bench/motor/motor_step.h"
#include "support/bench_campaign.h"

namespace ident::bench {
namespace {

struct Edge {
  double t, delta;
};

/// What the simulation depends on; the last two are the state at the first row.
struct Constants {
  double km, omega_m, zeta_m, dead_time, Omega, Omega_dot;
};
constexpr std::size_t kConstants = 6;

/// [Phang 22] by Runge-Kutta, with a step boundary at every sample and every delayed edge.
std::vector<double> simulated(const Constants& c, const StepTest& test, const std::vector<double>& t,
                              const std::vector<Edge>& edges) {
  const auto target_of = [&](double delta) {
    return test.Omega_0 + c.km * delta * (1.0 + test.curvature * (delta - 0.5));
  };
  double now = t.front(), x = c.Omega, v = c.Omega_dot, omega = c.omega_m;
  std::size_t edge = 0;
  double target = target_of(edges[0].delta);
  const auto integrate_to = [&](double end) {
    const double length = end - now;
    const int steps =
        std::max(1, static_cast<int>(std::ceil(length * std::max(2000.0, 40.0 * omega * c.zeta_m))));
    const double h = length / steps;
    const auto rate = [&](double y, double w) {
      return omega * omega * (target - y) - 2.0 * c.zeta_m * omega * w;
    };
    for (int i = 0; i < steps && length > 0.0; ++i) {
      const double k1 = rate(x, v), v2 = v + h / 2 * k1, k2 = rate(x + h / 2 * v, v2);
      const double v3 = v + h / 2 * k2, k3 = rate(x + h / 2 * v2, v3), v4 = v + h * k3;
      const double k4 = rate(x + h * v3, v4);
      x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    now = end;
  };
  std::vector<double> Omega;
  for (const double at : t) {
    while (edge + 1 < edges.size() && edges[edge + 1].t + c.dead_time <= at) {
      ++edge;
      integrate_to(std::max(now, edges[edge].t + c.dead_time));
      target = target_of(edges[edge].delta);
      omega = edges[edge].delta < edges[edge - 1].delta ? test.down_ratio * c.omega_m : c.omega_m;
    }
    integrate_to(at);
    Omega.push_back(x);
  }
  return Omega;
}

std::array<double, kConstants> as_array(const Constants& c) {
  return {c.km, c.omega_m, c.zeta_m, c.dead_time, c.Omega, c.Omega_dot};
}

Constants from_array(const std::array<double, kConstants>& a) { return {a[0], a[1], a[2], a[3], a[4], a[5]}; }

/// Cramer-Rao bound of all constants from the clean rows, by differences of the simulation. Autocorrelated
/// noise is decorrelated row by row; it comes without outliers.
Eigen::MatrixXd bound(const Constants& truth, const StepTest& test, const std::vector<double>& t,
                      const std::vector<Edge>& edges, const std::vector<bool>& clean) {
  const auto n = static_cast<Eigen::Index>(t.size());
  Eigen::MatrixXd J(n, static_cast<Eigen::Index>(kConstants));
  for (std::size_t k = 0; k < kConstants; ++k) {
    auto above = as_array(truth), below = above;
    const double e = 1e-5 * std::max(std::fabs(above[k]), k == 3 ? 0.1 : 1.0);
    above[k] += e;
    below[k] -= e;
    const std::vector<double> high = simulated(from_array(above), test, t, edges);
    const std::vector<double> low = simulated(from_array(below), test, t, edges);
    for (std::size_t i = 0; i < t.size(); ++i)
      J(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          clean[i] ? (high[i] - low[i]) / (2 * e) : 0.0;
  }
  const double rho = test.disturbance.rho;
  const Eigen::MatrixXd before = J.topRows(n - 1);
  J.bottomRows(n - 1) = (J.bottomRows(n - 1) - rho * before).eval() / std::sqrt(1.0 - rho * rho);
  return test.noise * test.noise *
         (J.transpose() * J).llt().solve(Eigen::MatrixXd::Identity(J.cols(), J.cols()));
}

}  // namespace

GeneratedTable motor_steps(const BenchVehicle& vehicle, Random& random, const StepTest& test) {
  const double plateau =
      std::max(0.4, 5.0 * (2.0 * vehicle.zeta_m + 1.0) / vehicle.omega_m + vehicle.dead_time);
  const std::vector<double> levels = {0.3, 0.6, 0.4, 0.8, 0.5, 0.7, 0.2};
  std::vector<double> t, delta;
  std::vector<Edge> edges;
  for (std::size_t p = 0; p < levels.size(); ++p) {
    const double end = plateau * static_cast<double>(p + 1);
    while (t.empty() || t.back() < end) {
      t.push_back(t.empty() ? 0.0 : t.back() + random.uniform(0.7, 1.3) / test.rate);
      delta.push_back(levels[p]);
      if (edges.size() == p) edges.push_back({t.back(), levels[p]});
    }
  }
  const double start = test.Omega_0 + vehicle.km * levels[0] * (1.0 + test.curvature * (levels[0] - 0.5));
  const Constants truth{vehicle.km, vehicle.omega_m, vehicle.zeta_m, vehicle.dead_time, start, 0.0};
  std::vector<double> Omega = simulated(truth, test, t, edges);
  std::vector<bool> clean(t.size(), true);
  ColouredNoise noise(random, test.disturbance.rho);
  for (std::size_t i = 0; i < t.size(); ++i) {
    Omega[i] += test.noise * noise.next();
    if (!random.chance(test.disturbance.outliers)) continue;
    clean[i] = false;
    Omega[i] += test.noise * (random.chance(0.5) ? 1 : -1) * random.uniform(8.0, 60.0);
  }
  GeneratedTable result{.noise = test.noise};
  const Eigen::MatrixXd C = bound(truth, test, t, edges, clean);
  constexpr std::array names = {"km", "omega_m", "zeta_m", "dead_time"};
  for (std::size_t k = 0; k < names.size(); ++k)
    result.cramer_rao[names[k]] = std::sqrt(C(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)));
  result.table.file = "steps.csv";
  result.table.columns = {
      {.name = "t", .values = t}, {.name = "delta", .values = delta}, {.name = "omega", .values = Omega}};
  for (std::size_t i = 0; i < t.size(); ++i) result.table.line.push_back(static_cast<long>(i) + 2);
  return result;
}

Tallies motor_campaign(int runs, std::uint64_t seed, const Disturbance& disturbance) {
  Tallies tallies;
  Random random(seed);
  for (int run = 0; run < runs; ++run) {
    const BenchVehicle vehicle = random_vehicle(random);
    const StepTest test{.rate = random.log_uniform(100.0, 250.0),
                        .noise = vehicle.km * random.log_uniform(0.001, 0.005),
                        .disturbance = disturbance};
    const GeneratedTable data = motor_steps(vehicle, random, test);
    const Result result = estimate_motor({data.table});
    const std::map<std::string, double> truth = {{"km", vehicle.km},
                                                 {"omega_m", vehicle.omega_m},
                                                 {"zeta_m", vehicle.zeta_m},
                                                 {"dead_time", vehicle.dead_time}};
    for (const auto& [name, value] : truth)
      tallies[name].add(*result.find(name), value, data.cramer_rao.at(name));
  }
  return tallies;
}

}  // namespace ident::bench
