// Step response and its times, with deviations by the chain rule.
#include "ident/bench/motor/motor_step_response.h"

#include <cmath>

#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

constexpr int kPoints = 120;
constexpr double kOneTimeConstant = 0.6321205588285577;  // 1 - 1/e

/// Derivatives with respect to omega_m, zeta_m, dead_time as a gradient of the fit's unknowns.
Eigen::VectorXd gradient(const LeastSquaresFit& fit, const std::array<double, 3>& slope) {
  Eigen::VectorXd g = Eigen::VectorXd::Zero(fit.x.size());
  g(fit.index("omega_m")) = slope[0];
  g(fit.index("zeta_m")) = slope[1];
  g(fit.index("dead_time")) = slope[2];
  return g;
}

/// When the answer first reaches a level, and how that depends on omega_m, zeta_m, dead_time.
struct Crossing {
  double t;
  std::array<double, 3> slope;
};

Crossing crossing(const MotorShape& shape, double level) {
  double step = 0.02 * (2.0 * shape.zeta_m + 1.0) / shape.omega_m, low = shape.dead_time, high = low;
  while (step_answer(shape, high).value < level) {
    low = high;
    high += step;
    step *= 1.02;
  }
  for (int i = 0; i < 100 && high - low > 1e-15; ++i) {
    const double middle = 0.5 * (low + high);
    (step_answer(shape, middle).value < level ? low : high) = middle;
  }
  const StepAnswer at = step_answer(shape, high);
  return {high, {-at.slope[0] / at.rate, -at.slope[1] / at.rate, -at.slope[2] / at.rate}};
}

}  // namespace

StepResponse step_response(const MotorFit& motor) {
  const MotorShape& shape = motor.shape;
  const LeastSquaresFit& fit = motor.fit;
  StepResponse result;
  const auto time = [&](const char* name, double value, const std::array<double, 3>& slope) {
    return derived_parameter(fit, name, value, gradient(fit, slope), "s", "motor");
  };
  const Crossing t10 = crossing(shape, 0.1), t63 = crossing(shape, kOneTimeConstant),
                 t90 = crossing(shape, 0.9);
  std::array<double, 3> rise{}, constant = t63.slope;
  for (std::size_t k = 0; k < 3; ++k) rise[k] = t90.slope[k] - t10.slope[k];
  constant[2] -= 1.0;
  const double lag = 2.0 * shape.zeta_m / shape.omega_m;
  result.rise_time = time("rise_time", t90.t - t10.t, rise);
  result.time_constant = time("time_constant", t63.t - shape.dead_time, constant);
  result.lag = time("lag", lag, {-lag / shape.omega_m, 2.0 / shape.omega_m, 0.0});
  result.total_lag =
      time("total_lag", lag + shape.dead_time, {-lag / shape.omega_m, 2.0 / shape.omega_m, 1.0});

  const double end = 3.0 * t90.t - 2.0 * std::min(shape.dead_time, 0.0);
  for (int i = 0; i <= kPoints; ++i) {
    const double t = end * i / kPoints;
    const StepAnswer answer = step_answer(shape, t);
    result.t.push_back(t);
    result.value.push_back(answer.value);
    result.std.push_back(fit.std_of(gradient(fit, answer.slope)));
  }
  return result;
}

}  // namespace ident
