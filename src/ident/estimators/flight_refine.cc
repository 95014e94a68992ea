// Puts the refinement together: start, fit, identifiability, disagreement with the bench, validation.
#include "ident/estimators/flight_refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/estimators/flight_channels.h"
#include "ident/estimators/flight_entry.h"
#include "ident/estimators/flight_hover.h"
#include "ident/estimators/flight_impossible.h"
#include "ident/estimators/flight_inertia.h"
#include "ident/estimators/flight_input_doubt.h"
#include "ident/estimators/flight_jitter.h"
#include "ident/estimators/flight_logs_agree.h"
#include "ident/estimators/flight_profile.h"
#include "ident/estimators/flight_residuals.h"
#include "ident/estimators/flight_self_test.h"
#include "ident/estimators/flight_steady_push.h"
#include "ident/estimators/flight_steady_turn.h"
#include "ident/estimators/flight_thrust_curve.h"
#include "ident/estimators/flight_trim.h"
#include "ident/estimators/flight_validation.h"
#include "ident/estimators/flight_watched.h"
#include "ident/estimators/statistics.h"

namespace ident {
namespace {

using Eigen::VectorXd;

constexpr std::size_t kProfiles = 3;  // of weak constants; more take longer than the fit

constexpr double kMoved = 1e-6;  // of what was known

nlohmann::ordered_json process_json(const std::array<ColouredNoise, 3>& noise) {
  nlohmann::ordered_json std = nlohmann::ordered_json::array(), time = std;
  for (const ColouredNoise& axis : noise) std.push_back(axis.sigma), time.push_back(axis.tau);
  return {{"std", std}, {"correlation_time", time}};
}

}  // namespace

std::vector<Parameter> flight_parameters(const Theta& theta, const FlightFit& fit,
                                         const std::string& source) {
  std::vector<Parameter> out;
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    if (c.watched) continue;
    Parameter p;
    p.name = c.name;
    p.value = theta.physical(fit.u, i);
    p.std = theta.deviation(fit.u, i, fit.covariance);
    p.naive_std = theta.deviation(fit.u, i, fit.naive_covariance);
    p.unit = parameter_unit(c.name);
    p.source = source;
    // In the logarithm for positive constants: the interval stays positive.
    const double z = 1.96 * std::sqrt(fit.covariance(i, i));
    p.ci95 = c.positive && z < 3 && !c.prior_std ? std::array{p.value * std::exp(-z), p.value * std::exp(z)}
                                                 : std::array{p.value - 1.96 * p.std, p.value + 1.96 * p.std};
    if (c.prior_std) {
      p.prior_value = c.prior_value, p.prior_std = *c.prior_std;
      const double ratio = std::min(*p.naive_std / *c.prior_std, 1.0);
      p.from_flight = 1 - ratio * ratio;
      // The pull compares the two sources of information: what the flight alone would say (naive variance v,
      // in truth `colour` times that) with what was stated. The estimate moves by a share of their
      // difference.
      const double stated = *c.prior_std * *c.prior_std, share = std::max(1 - ratio * ratio, 1e-4);
      const double alone = stated * (1 - share) / share, colour = std::pow(p.std / *p.naive_std, 2);
      p.pull = (p.value - c.prior_value) / (share * std::sqrt(stated + colour * alone));
      p.identifiable = p.std < 0.5 * *c.prior_std;
    } else {
      p.from_flight = 1.0;
      // What is zero for most vehicles is known by its usual size.
      const bool mostly_zero = c.index == param::dead_time || c.index == param::Omega_0;
      p.identifiable = p.std < 0.1 * std::max(std::abs(p.value), mostly_zero ? c.scale : 0.0);
    }
    const bool told = c.prior_std ? std::abs(p.value - c.prior_value) > kMoved * *c.prior_std
                                  : p.std < std::abs(p.value) && c.name.find('.') == std::string::npos;
    p.joint = !p.identifiable && told;
    if (!p.identifiable)
      p.note = c.prior_std ? "these logs say little beyond what was known" : "these logs do not determine it";
    out.push_back(p);
  }
  return out;
}

Correlation flight_correlation(const Theta& theta, const Eigen::MatrixXd& covariance) {
  Correlation out;
  std::vector<Eigen::Index> at;
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    if (!c.watched && c.times < 0) out.names.push_back(c.name), at.push_back(i);
  }
  const VectorXd s = covariance.diagonal()(at).cwiseSqrt().cwiseInverse();
  out.matrix = s.asDiagonal() * covariance(at, at) * s.asDiagonal();
  return out;
}

std::vector<std::string> combinations(const Theta& theta, const FlightFit& fit,
                                      const std::vector<Parameter>& parameters) {
  std::vector<std::string> out;
  const auto usable = [&](std::size_t i) {
    return theta.constants()[i].positive && !parameters[i].identifiable;
  };
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (i == k || !usable(i) || !usable(k)) continue;
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(k);
      const double vi = fit.covariance(a, a), vk = fit.covariance(b, b), c = fit.covariance(a, b);
      // log(x_i) + e log(x_k) has the least variance for e = -c/vk; a simple exponent that leaves little is a
      // finding.
      for (const double e : {1.0, 2.0, -1.0, -2.0}) {
        const double v = vi + 2 * e * c + e * e * vk;
        if (v > 0.04 * std::min(vi, e * e * vk) || (std::abs(e) == 1.0 && i > k)) continue;
        const std::string power = std::abs(e) == 2 ? "^2" : "";
        const std::string both = e > 0 ? parameters[i].name + " " + parameters[k].name + power
                                       : parameters[i].name + "/" + parameters[k].name + power;
        out.push_back(fmt::format("{} and {} only as {}", parameters[i].name, parameters[k].name, both));
      }
    }
  }
  return out;
}

bool disagrees(const Parameter& p) {
  const bool heard = p.from_flight && *p.from_flight > 0.05;  // else flight has no say in it
  return p.pull && heard && std::abs(*p.pull) > 3;
}

void warn_of_disagreement(Result& result, std::string_view advice) {
  for (const Parameter& p : result.parameters)
    if (disagrees(p))
      result.warn(
          "prior_disagrees",
          fmt::format(
              "{}: flight says {}, the value given beforehand was {} ({:+.1f} standard deviations): one of "
              "the two is wrong, or {}",
              p.name, format_with_uncertainty(p.value, p.std),
              format_with_uncertainty(*p.prior_value, *p.prior_std), *p.pull, advice));
}

void warn_about(Result& result, const Theta& theta, const FlightFit& fit) {
  warn_of_disagreement(result, "the model lacks an effect (try ident gap)");
  doubt_negative_dead_time(result);
  std::string unknown;
  for (const Parameter& p : result.parameters)
    if (!p.identifiable) unknown += (unknown.empty() ? "" : ", ") + p.name;
  if (!unknown.empty()) {
    std::string text = "these logs do not determine " + unknown;
    std::vector<std::string> pairs;
    if (!result.has_warning("thrust_level")) pairs = combinations(theta, fit, result.parameters);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      text += (i == 0 ? "; what they do determine: " : ", ") + pairs[i];
    result.warn("not_identifiable", text);
  }
}

// What a filter made late passes for lag of the motors where nothing else tells.
bool filter_lag_is_open(const Result& result, const Signals& logged) {
  return !logged.attitude && logged.commands && result.has_warning("filtered_noise");
}

void warn_of_filter_lag(Result& result, const Signals& logged) {
  if (!filter_lag_is_open(result, logged) || result.find("dead_time")) return;
  result.warn(
      "filter_lag",
      "rates and specific force were filtered, and without attitude nothing tells how late that made "
      "them: it counts as lag of the motors, which comes out longer by that; '--free dead_time' takes "
      "a delay out of it");
}

Result refine_flight(const Vehicle& vehicle, std::span<const FlightLog> logs, const RefineOptions& options) {
  Result result;
  result.command = "flightlog";
  auto [p, record, tested, vibration] = enter_flight(vehicle, logs, result);
  if (only_trim(record.signals)) {
    refine_trim(result, record, p, options.free);
    result.sections.push_back(data_health(record, logs, initial_noise(record), vibration));
    if (const std::string wrong = disqualified(tested); !wrong.empty()) distrust(result, wrong);
    return result;
  }
  require_turning(record.signals);
  std::vector<FreeConstant> constants = free_constants(vehicle, p, options.free);
  if (!record.signals.commands) leave_out_motors(constants);
  const std::vector<FreeConstant> known = constants;
  std::vector<std::string> held;
  if (is_hover(tested)) held = hold_for_hover(constants);
  std::vector<std::string> watched;
  if (held.empty()) watched = {"Omega_0", "Jp"};
  if (held.empty() && !filter_lag_is_open(result, record.signals)) watched.emplace_back("dead_time");
  auto [free, fit] =
      fit_and_watch(vehicle, p, record, constants,
                    {.watched = watched, .also = options.free, .progress = options.progress}, result);
  const Theta& theta = *free;
  if (const FeltJitter jitter = felt_jitter(record, theta, fit);
      jitter.matters() && may_do_without_commands(logs, options.free)) {
    fit.smoother.reset();
    Result by_speeds = refine_flight(vehicle, without_commands(logs), options);
    std::erase_if(by_speeds.warnings, [](const Warning& w) { return w.code == "speeds_as_input"; });
    by_speeds.warnings.push_back(jitter.taken_as_input());
    return by_speeds;
  }
  if (options.bootstrap > 0) fit.covariance = bootstrap_covariance(fit, theta, options.bootstrap);
  const VectorXd moved = moved_by_rougher_speeds(record, theta, fit);
  fit.covariance += moved * moved.transpose();
  FlightFit body = fit;
  body.smoother.reset(), body.u = nearest_body(theta, fit);
  result.parameters = flight_parameters(theta, body, "flightlog");
  as_before_flight(result.parameters, known, held);
  for (const Warning& w : logs_agree(record, logs, theta, fit))
    result.warnings.push_back(w), tested.push_back(w);
  const SteadyPush push = steady_push(record, fit);
  warn_of_steady_push(result, push, logs, vehicle.g);
  if (disqualified(tested).empty())
    warn_of_steady_turn(result, steady_turn(record, theta, fit), record, logs);
  if (vehicle.signs == Signs::first_principles) doubt_negative_rotor_inertia(result);
  doubt_contradicted(result);
  warn_about(result, theta, fit);
  warn_of_filter_lag(result, record.signals);
  warn_of_inertia(result, theta, fit);
  result.fit["seconds"] = record.duration;
  result.fit["steps"] = fit.steps;
  result.fit["segment_seconds"] = fit.chunk_seconds;
  result.fit["process_noise"] = nlohmann::ordered_json::array();  // of each log
  for (const AirNoise& air : fit.noise.air)
    result.fit["process_noise"].push_back(
        {{"angular_acceleration", process_json(air.w_dot)}, {"acceleration", process_json(air.v_dot)}});
  result.fit["axes_of_acceleration"] = fit.noise.axes == GustAxes::world ? "world" : "body";
  static constexpr std::array shown = {"attitude", "velocity", "position"};
  for (std::size_t g = 0; g < shown.size(); ++g)
    if (record.layout.shown_error[g] >= 0)
      result.fit["slow_errors"][shown[g]] = process_json(fit.noise.slow[g]);
  nlohmann::ordered_json levels;
  for (int c = 0; c < kChannels; ++c)
    if (record.sigma[static_cast<std::size_t>(c)] != 1.0)
      levels[channel_name(c)] = fit.noise.sigma[static_cast<std::size_t>(c)];
  result.fit["noise"] = levels;
  std::vector<ThrustAt> thrust;
  if (!push.matters(vehicle.g)) thrust = thrust_over_commands(record, logs, theta, body);
  if (!thrust.empty()) result.fit["thrust_by_command"] = as_json(thrust);
  const int n = static_cast<int>(result.parameters.size());
  result.correlation = flight_correlation(theta, fit.covariance);
  const auto& [names, correlation] = result.correlation;
  for (Eigen::Index i = 0; i < correlation.rows(); ++i)
    for (Eigen::Index k = 0; k < i; ++k)
      if (std::abs(correlation(i, k)) > 0.95)
        result.warn("correlated", fmt::format("{} and {} are known only together (correlation {:.3f})",
                                              names[static_cast<std::size_t>(k)],
                                              names[static_cast<std::size_t>(i)], correlation(i, k)));
  result.prior_correlation =
      vehicle.correlation.part([&](const std::string& name) { return result.find(name) != nullptr; });
  if (options.shown != Shown::numbers) {
    result.sections.push_back(data_health(record, logs, fit.noise, vibration));
    if (!thrust.empty()) result.sections.push_back(thrust_section(thrust));
    result.sections.push_back(flight_residuals(record, fit));
    result.sections.push_back(outside_accelerations(record, fit));
  }
  if (options.shown == Shown::pictures)
    std::ranges::move(profile_sections(fit, theta, result.parameters, kProfiles),
                      std::back_inserter(result.sections));
  bool worse = false;
  if (options.validate && record.duration > 6) {
    const FlightRecord held_out = held_out_of(record, kTrainingShare);
    FlightFit view = fit;
    view.u = fit_of_training(fit, record, theta, kTrainingShare);
    view.u = nearest_body(theta, view);
    VectorXd before = view.u;
    before.head(n).setZero();                     // the constants as stated, with the gyro biases of the fit
    fit.smoother.reset(), view.smoother.reset();  // the largest thing in memory
    Validation validation = validate_refined(held_out, theta, before, view, options.shown);
    result.fit["held_out"] = validation.horizons;
    result.sections.push_back(std::move(validation.section));
    if (!validation.worse.empty()) result.warn("predicts_worse", validation.worse), worse = true;
  }
  int determined = 0;
  for (const Parameter& q : result.parameters) determined += q.identifiable;
  result.verdict = fmt::format("{} of {} parameters are determined by {:.0f} s of flight{}.", determined,
                               result.parameters.size(), record.duration,
                               worse ? ", but they predict other flight worse than those stated do" : "");
  if (const std::string wrong = disqualified(tested); !wrong.empty()) distrust(result, wrong);
  return result;
}

}  // namespace ident
