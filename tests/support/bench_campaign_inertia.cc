// Generated pendulum data, and the campaign of the inertia estimator on them.
#include <array>
#include <cmath>

#include "ident/bench/inertia/trifilar_inertia.h"
#include "support/bench_campaign.h"

namespace ident::bench {
namespace {

constexpr double kGravity = 9.81;

double square(double v) { return v * v; }

}  // namespace

GeneratedTable pendulum(const BenchVehicle& vehicle, Random& random, int rows,
                        const Disturbance& disturbance) {
  const double radius = 1.2 * vehicle.arm, length = random.uniform(0.6, 1.5);
  const double m_p = vehicle.mass * random.uniform(0.2, 0.6), m = vehicle.mass + m_p;
  const double J_p = 0.5 * m_p * square(radius);
  const double offset = 0.05 * vehicle.arm, c = vehicle.mass * offset / m;
  GeneratedTable result{.noise = random.log_uniform(5e-4, 5e-3)};
  const std::array names = {"x", "y", "z", "platform"};
  const std::array J_v = {vehicle.Jxx, vehicle.Jyy, vehicle.Jzz, 0.0};
  std::vector<double> period, mass, radii, lengths, offsets;
  TextColumn axis{.name = "axis"};
  std::array<double, 4> variance{};  // of the hanging inertia of an axis, from its clean rows
  for (std::size_t a = 0; a < 4; ++a) {
    const bool empty = a == 3;
    const double J = empty ? J_p : J_v[a] + J_p + vehicle.mass * m_p / m * square(offset);
    const double hung = empty ? m_p : m, r2 = empty ? square(radius) : square(radius) - square(c);
    const double T = 2.0 * M_PI * std::sqrt(J * length / (hung * kGravity * r2));
    int clean = 0;
    for (int i = 0; i < rows; ++i) {
      const bool outlier = random.chance(disturbance.outliers);
      clean += !outlier;
      double seen = T + result.noise * random.normal();
      if (outlier) seen = T + result.noise * (random.chance(0.5) ? 1 : -1) * random.uniform(8.0, 40.0);
      period.push_back(seen);
      axis.values.push_back(names[a]);
      mass.push_back(hung);
      radii.push_back(radius);
      lengths.push_back(length);
      offsets.push_back(empty ? 0.0 : offset);
      result.table.line.push_back(static_cast<long>(period.size()) + 1);
    }
    variance[a] = square(2.0 * J / T * result.noise) / clean;  // dJ/dT = 2 J/T
  }
  for (std::size_t a = 0; a < 3; ++a)
    result.cramer_rao[std::array{"Jxx", "Jyy", "Jzz"}[a]] = std::sqrt(variance[a] + variance[3]);
  result.table.file = "pendulum.csv";
  result.table.text = {axis};
  result.table.columns = {{.name = "period", .values = period},
                          {.name = "mass", .values = mass},
                          {.name = "radius", .values = radii},
                          {.name = "length", .values = lengths},
                          {.name = "offset", .values = offsets}};
  return result;
}

Tallies inertia_campaign(int runs, std::uint64_t seed, const Disturbance& disturbance) {
  Tallies tallies;
  Random random(seed);
  for (int run = 0; run < runs; ++run) {
    const BenchVehicle vehicle = random_vehicle(random);
    const GeneratedTable data = pendulum(vehicle, random, 10, disturbance);
    const Result result = estimate_inertia({data.table});
    const std::map<std::string, double> truth = {
        {"Jxx", vehicle.Jxx}, {"Jyy", vehicle.Jyy}, {"Jzz", vehicle.Jzz}};
    for (const auto& [name, value] : truth)
      tallies[name].add(*result.find(name), value, data.cramer_rao.at(name));
  }
  return tallies;
}

}  // namespace ident::bench
