// Scores both models as the ladder of a refinement scores its rungs.
//
// A prediction starts from a measured state and is compared with another one, so that a perfect model errs by
//
// (1) velocity and rates: floor^2 = 2 sum sigma^2
// (2) attitude, T seconds ahead: floor^2 = 2 sum sigma^2 + T^2 sum sigma_gyro^2
//
// with sums over three axes, to first order in the noise of the sensors. Gusts and the noise of motors come
// on top and grow with T.
#include "ident/gap/evidence/motion_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ident/flight/ladder/held_out_errors.h"
#include "ident/result/json_number.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kByChance = 2.0;  // standard deviations of a mean square over windows with three axes each

struct Score {
  const char *name, *unit;
  Metric metric;
  double per_SI;
  bool logged;
};

double sum_of_squares(const std::array<double, kChannels>& sigma, int first) {
  double sum = 0;
  for (int c = first; c < first + 3; ++c) {
    const double s = sigma[static_cast<std::size_t>(c)];
    sum += s * s;
  }
  return sum;
}

// Square of what a perfect model errs by; NaN where the state was not measured by a sensor of its own.
double floor_of(Metric metric, double T, const Signals& logged, const std::array<double, kChannels>& sigma) {
  const double gyro = logged.rates ? sum_of_squares(sigma, kGyro) : kNaN;
  if (metric == Metric::velocity)
    return logged.velocity ? 2 * sum_of_squares(sigma, kVelocity) : kNaN;  // (1)
  if (metric == Metric::rate) return 2 * gyro;                             // (1)
  if (metric == Metric::rotor_speed) {                                     // (1), of a rotor in the mean
    const double s = sigma[kRotorChannel];
    return 2 * s * s;
  }
  return 2 * sum_of_squares(sigma, kAttitude) + T * T * gyro;  // (2)
}

// What both models err by at one horizon. A gap that noise of so few windows makes is none to be closed.
Json horizon_json(const Score& score, std::size_t h, const std::vector<WindowErrors>& before,
                  const std::vector<WindowErrors>& after, double floor_squared) {
  const double of_stated = error_of(before, score.metric, h), of_found = error_of(after, score.metric, h);
  const auto windows = std::ranges::count_if(before, [&](const WindowErrors& w) {
    return std::isfinite(w.of[static_cast<std::size_t>(score.metric)][h]);
  });
  const double by_chance = kByChance * std::sqrt(2.0 / (3.0 * static_cast<double>(windows))) * floor_squared;
  const double gap = of_stated * of_stated - floor_squared;
  const double closed = gap > by_chance ? 1 - (of_found * of_found - floor_squared) / gap : kNaN;
  return {{"seconds", kLadderHorizons[h]},
          {"before", number_or_null(score.per_SI * of_stated)},
          {"after", number_or_null(score.per_SI * of_found)},
          {"noise_floor", number_or_null(score.per_SI * std::sqrt(floor_squared))},
          {"closed", number_or_null(closed)}};
}

void take_off_bias(FlightRecord& record, const std::vector<std::array<double, 3>>& bias) {
  for (FlightArc& arc : record.arcs) {
    const auto& of = bias[static_cast<std::size_t>(arc.log)];
    for (BodyState<double>& body : arc.body) body.w_B -= Vec3<double>(of[0], of[1], of[2]);
  }
}

}  // namespace

Json motion_errors(FlightRecord record, const ComparedModels& models) {
  if (record.signals.rates) take_off_bias(record, models.gyro_bias);
  const MeasuredMotion motion = measured_motion(record);
  const std::vector<WindowErrors> before = held_out_errors(motion, models.stated),
                                  after = held_out_errors(motion, models.found);
  const std::array scores{
      Score{"forces", "m/s", Metric::velocity, 1.0, motion.forces},
      Score{"moments", "rad/s", Metric::rate, 1.0, motion.moments},
      Score{"open_loop", "deg", Metric::open_attitude, kDegrees, motion.velocity && motion.moments},
      Score{"rotor_speeds", "rad/s", Metric::rotor_speed, 1.0, motion.speeds}};
  Json out;
  for (const Score& one : scores) {
    out[one.name] = nullptr;
    if (!one.logged) continue;
    Json horizons = Json::array();
    for (std::size_t h = 0; h < kLadderHorizons.size(); ++h)
      horizons.push_back(horizon_json(
          one, h, before, after, floor_of(one.metric, kLadderHorizons[h], record.signals, models.sigma)));
    out[one.name] = {{"unit", one.unit}, {"horizons", horizons}};
  }
  return out;
}

}  // namespace ident
