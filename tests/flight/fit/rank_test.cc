// Erratum 7 as the estimator sees it: the directions that a flight cannot tell come out of the data's own
// information, not of a list.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "ident/effects/all_parameters.h"
#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/make_record.h"
#include "ident/sim/simulate.h"

namespace ident {
namespace {

const std::vector<std::string> kAll = {"m", "kT", "kQ", "km", "omega_m", "zeta_m", "Jxx", "Jyy", "Jzz", "Jp"};

Vehicle quadrotor() {
  Vehicle v;
  v.rotors = layout_rotors("4sp", 0.17, 0.17);
  v.parameters = {{"m", {0.5, {}}},      {"kT", {6e-6, {}}},    {"kQ", {8.8e-8, {}}}, {"km", {800, {}}},
                  {"omega_m", {30, {}}}, {"zeta_m", {0.9, {}}}, {"Jxx", {3e-3, {}}},  {"Jyy", {3.2e-3, {}}},
                  {"Jzz", {5.4e-3, {}}}, {"Jp", {1.5e-5, {}}},  {"alpha", {0.17, {}}}};
  return v;
}

/// Information of a noise-free flight on the logarithms of all constants.
Eigen::MatrixXd information(bool rotor_speeds) {
  const Vehicle vehicle = quadrotor();
  SimulationOptions options;
  options.duration = 12.0, options.rate = 100.0, options.longest_step = 0.0;
  options.noise = noise_level("none");
  options.signals.rotor_speeds = rotor_speeds ? 1 : 0;
  const std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  std::vector<FreeConstant> constants;
  for (const std::string& name : kAll) {
    const int index = find_parameter(name)->index;
    constants.push_back(
        {.name = name, .index = index, .positive = true, .start = p[static_cast<std::size_t>(index)]});
  }
  const Theta theta(p, constants, 1, true);
  NoiseModel noise = initial_noise(record);
  const SensorNoise sensor = noise_level("typical");
  for (std::size_t k = 0; k < 3; ++k)
    noise.sigma[kGyro + k] = sensor.gyro, noise.sigma[kForce + k] = sensor.accelerometer,
                        noise.sigma[kAttitude + k] = sensor.attitude,
                        noise.sigma[kVelocity + k] = sensor.velocity,
                        noise.sigma[kPosition + k] = sensor.position;
  for (std::size_t n = kRotorChannel; n < kChannels; ++n) noise.sigma[n] = 1.0;
  FlightSmoother smoother(record, theta, noise, 0.5);
  const auto n = static_cast<Eigen::Index>(kAll.size());
  return smoother.linearize(Eigen::VectorXd::Zero(theta.size())).S.topLeftCorner(n, n);
}

/// Exponents by which the constants of `kAll` scale.
Eigen::VectorXd scaling(double m, double kT, double kQ, double km, double J, double Jp) {
  return (Eigen::VectorXd(10) << m, kT, kQ, km, 0, 0, J, J, J, Jp).finished().normalized();
}

double seen(const Eigen::MatrixXd& S, const Eigen::VectorXd& direction) {
  return std::sqrt(std::max(direction.dot(S * direction), 0.0));  // standard deviations per unit of logarithm
}

// Rounding over many links leaves less than this, far below any prior: in standard deviations per unit of
// logarithm, and squared.
constexpr double kNothing = 0.3;

TEST(FlightRank, WithRotorSpeedsOneScalingIsInvisibleAndNothingElse) {
  const Eigen::MatrixXd S = information(true);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(S).eigenvalues();
  EXPECT_LT(seen(S, scaling(1, 1, 1, 0, 1, 1)), kNothing);
  EXPECT_LT(values[0], kNothing * kNothing);
  EXPECT_GT(values[1], 10.0);
}

TEST(FlightRank, WithoutRotorSpeedsTheMotorGainIsInvisibleToo) {
  const Eigen::MatrixXd S = information(false);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(S).eigenvalues();
  EXPECT_LT(seen(S, scaling(1, 1, 1, 0, 1, 1)), kNothing);
  EXPECT_LT(seen(S, scaling(0, -2, -2, 1, 0, -1)), kNothing);
  EXPECT_LT(values[1], kNothing * kNothing);
  EXPECT_GT(values[2], 10.0);
}

}  // namespace
}  // namespace ident
