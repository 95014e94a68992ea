// The faster of two poles, at omega_m (zeta_m +- sqrt(zeta_m^2 - 1)), leaves no trace: zeta_m has no upper
// bound, and omega_m grows with it.
#include "ident/flight/fit/first_order_motors.h"

#include <algorithm>
#include <cmath>

#include "ident/result/parameter.h"

namespace ident {
namespace {

constexpr double kOverdamped = 3.0;  // zeta_m of which the second pole is 34 times as fast as the first
constexpr double kKnown = 0.1;       // standard deviation of the logarithm of the lag
constexpr double kHeldAt = 50.0, kHeldTo = 0.5;

int index_of(const Theta& theta, const char* name) {
  for (int i = 0; i < theta.constants_count(); ++i)
    if (theta.name(i) == name) return i;
  return -1;
}

}  // namespace

std::optional<MotorLag> first_order_lag(const Vehicle& vehicle, const Theta& theta, const FlightFit& fit,
                                        const std::vector<Parameter>& parameters) {
  const auto is_open = [&](const char* name) {
    const auto known = vehicle.parameters.find(name);
    const auto found = std::ranges::find(parameters, name, &Parameter::name);
    return !(known != vehicle.parameters.end() && known->second.std) && found != parameters.end() &&
           !found->identifiable;
  };
  const int omega = index_of(theta, "omega_m"), zeta = index_of(theta, "zeta_m");
  if (omega < 0 || zeta < 0 || !is_open("omega_m") || !is_open("zeta_m")) return {};
  const double omega_m = theta.physical(fit.u, omega), zeta_m = theta.physical(fit.u, zeta);
  const double to_omega = theta.slope(fit.u, omega) / omega_m, to_zeta = theta.slope(fit.u, zeta) / zeta_m;
  const auto variance = [&](double of_omega, double of_zeta) {  // of logarithms
    const double a = of_omega * to_omega, b = of_zeta * to_zeta;
    return a * a * fit.covariance(omega, omega) + 2 * a * b * fit.covariance(omega, zeta) +
           b * b * fit.covariance(zeta, zeta);
  };
  const double of_lag = std::sqrt(std::max(variance(-1, 1), 0.0));
  if (!(zeta_m > kOverdamped) || !(of_lag < kKnown)) return {};
  const double lag = 2 * zeta_m / omega_m;
  return MotorLag{lag, lag * of_lag};
}

Vehicle with_first_order_motors(Vehicle vehicle, const MotorLag& lag) {
  vehicle.parameters["zeta_m"] = {kHeldAt, kHeldTo};
  vehicle.parameters["omega_m"] = {2 * kHeldAt / lag.seconds, {}};
  return vehicle;
}

}  // namespace ident
