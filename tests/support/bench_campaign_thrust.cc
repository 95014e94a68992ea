// Generated thrust sweeps, and the campaign of the thrust estimator on them.
#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "ident/bench/thrust/thrust_sweep.h"
#include "support/bench_campaign.h"

namespace ident::bench {
namespace {

constexpr double kGravity = 9.81;
constexpr int kRepeats = 5, kAtRest = 5;

double square(double v) { return v * v; }

struct Propeller {
  double kT, kQ, km;
};

/// Four rotors that lift thrust_to_weight times the weight at full command.
Propeller propeller(const BenchVehicle& vehicle, Random& random) {
  const double full = vehicle.thrust_to_weight * vehicle.mass * kGravity / 4.0;
  const double kT = full / square(vehicle.km);
  return {kT, kT * vehicle.arm * random.uniform(0.05, 0.12), vehicle.km};
}

/// Rows of a Fisher information, in the order of time; a row that is missing tells nothing. First-order
/// autoregressive noise: what a row tells beyond the one before it.
class Information {
 public:
  Information(Eigen::Index unknowns, double rho) : sum_(unknowns, unknowns), rho_(rho) { sum_.setZero(); }
  void add(const Eigen::VectorXd& gradient, double sigma) {
    Eigen::VectorXd g = gradient / sigma;
    if (rho_ > 0.0 && last_.size() > 0) {
      const Eigen::VectorXd fresh = (g - rho_ * last_) / std::sqrt(1.0 - rho_ * rho_);
      last_ = g;
      g = fresh;
    } else {
      last_ = g;
    }
    sum_ += g * g.transpose();
  }
  void add(const Information& other) { sum_ += other.sum_; }
  double std(Eigen::Index i) const {
    return std::sqrt(sum_.ldlt().solve(Eigen::VectorXd::Unit(sum_.rows(), i))(i));
  }

 private:
  Eigen::MatrixXd sum_;
  Eigen::VectorXd last_;
  double rho_;
};

double spoilt(double value, double sigma, bool outlier, Random& random) {
  return outlier ? value + sigma * (random.chance(0.5) ? 1 : -1) * random.uniform(8.0, 40.0) : value;
}

}  // namespace

GeneratedTable thrust_sweep(const BenchVehicle& vehicle, double kT, double kQ, Random& random,
                            const Disturbance& disturbance) {
  const int set_points = 10 + static_cast<int>(random.uniform(0.0, 10.0));
  const double Omega_0 = 0.1 * vehicle.km, top = Omega_0 + vehicle.km, full_T = kT * square(top),
               full_Q = kQ * square(top);
  const double sigma_T = full_T * random.log_uniform(2e-3, 2e-2),
               sigma_Q = full_Q * random.log_uniform(2e-3, 2e-2),
               sigma_w = top * random.log_uniform(1e-3, 1e-2);
  const double tare_T = full_T * random.uniform(-0.05, 0.05), tare_Q = full_Q * random.uniform(-0.05, 0.05);
  GeneratedTable result{.noise = sigma_T};
  ColouredNoise noise_T(random, disturbance.rho), noise_Q(random, disturbance.rho);
  // Unknowns: kT, tare, kQ, tare, then the speed of each set-point.
  const Eigen::Index unknowns = 4 + set_points;
  Information of_T(unknowns, disturbance.rho), of_Q(unknowns, disturbance.rho), of_w(unknowns, 0.0),
      of_km(2, 0.0);
  std::vector<double> omega, thrust, torque, command;
  const auto row = [&](int set_point, double delta, double Omega) {
    const bool turns = set_point >= 0;
    const std::array out = {random.chance(disturbance.outliers), random.chance(disturbance.outliers),
                            turns && random.chance(disturbance.outliers)};
    thrust.push_back(spoilt(tare_T + kT * square(Omega) + sigma_T * noise_T.next(), sigma_T, out[0], random));
    torque.push_back(spoilt(tare_Q + kQ * square(Omega) + sigma_Q * noise_Q.next(), sigma_Q, out[1], random));
    omega.push_back(turns ? spoilt(Omega + sigma_w * random.normal(), sigma_w, out[2], random) : 0.0);
    command.push_back(delta);
    result.table.line.push_back(static_cast<long>(omega.size()) + 1);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(unknowns);
    g(0) = square(Omega), g(1) = 1.0;
    if (turns) g(4 + set_point) = 2.0 * kT * Omega;
    if (!out[0]) of_T.add(g, sigma_T);
    g.setZero();
    g(2) = square(Omega), g(3) = 1.0;
    if (turns) g(4 + set_point) = 2.0 * kQ * Omega;
    if (!out[1]) of_Q.add(g, sigma_Q);
    if (!turns || out[2]) return;
    of_w.add(Eigen::VectorXd::Unit(unknowns, 4 + set_point), sigma_w);
    of_km.add(Eigen::Vector2d(delta, 1.0), sigma_w);
  };
  for (int i = 0; i < kAtRest; ++i) row(-1, 0.0, 0.0);
  for (int s = 0; s < set_points; ++s) {
    const double delta = 0.1 + 0.9 * s / (set_points - 1);
    for (int i = 0; i < kRepeats; ++i) row(s, delta, Omega_0 + vehicle.km * delta);
  }
  of_T.add(of_Q);
  of_T.add(of_w);
  result.cramer_rao = {{"kT", of_T.std(0)}, {"kQ", of_T.std(2)}, {"km", of_km.std(0)}};
  result.table.file = "sweep.csv";
  result.table.columns = {{"omega", "omega", omega},
                          {"thrust", "thrust", thrust},
                          {"torque", "torque", torque},
                          {"delta", "delta", command}};
  return result;
}

Tallies thrust_campaign(int runs, std::uint64_t seed, const Disturbance& disturbance) {
  Tallies tallies;
  Random random(seed);
  for (int run = 0; run < runs; ++run) {
    const BenchVehicle vehicle = random_vehicle(random);
    const Propeller truth = propeller(vehicle, random);
    const GeneratedTable data = thrust_sweep(vehicle, truth.kT, truth.kQ, random, disturbance);
    const Result result = estimate_thrust({data.table});
    for (const auto& [name, value] :
         std::map<std::string, double>{{"kT", truth.kT}, {"kQ", truth.kQ}, {"km", truth.km}})
      tallies[name].add(*result.find(name), value, data.cramer_rao.at(name));
  }
  return tallies;
}

}  // namespace ident::bench
