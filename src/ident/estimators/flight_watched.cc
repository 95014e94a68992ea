// Omega_0, dead_time and Jp beside the constants of a fit.
#include "ident/estimators/flight_watched.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ident/core/error.h"
#include "ident/estimators/flight_fit_steps.h"
#include "ident/estimators/flight_steady_push.h"

namespace ident {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kHeld = 1e-6;  // of the unit step: a tenth of the speed at hover, 5 ms, a hundredth of J
constexpr std::ptrdiff_t kFewBlocks = 8;    // do not tell by how much coloured residuals spread scores;
constexpr double kUntold = 4.0;             // they count as that much then
constexpr double kBeyondDoubt = 25.0;       // squared standard deviations, or fall of the cost
constexpr double kBeyondDoubtOfYaw = 16.0;  // for Jp, which none of 56 flights without effect asks for then
constexpr double kByChance = 2.0;           // standard deviations
constexpr double kMatters = 1e-3;           // of the unit step: less is rounding
const std::string kOffset = "Omega_0", kDeadTime = "dead_time", kRotor = "Jp";
// Effects that are the same.
const std::string kDelay = "motor_delay.tau", kMomentum = "gyroscopic.Jp";

// By how much the logs contradict the watched constant `at`, in squared standard deviations.
double contradiction(const Theta& theta, const FlightFit& fit, Eigen::Index at) {
  // How far it moves when it is free, over the factor by which coloured residuals spread the scores it
  // leaves.
  PriorTerms prior = theta.prior(fit.u).loosened(at, 1.0);
  prior.slope[at] = 0;
  const Eigen::Index n = fit.u.size();
  MatrixXd F = MatrixXd::Zero(n, n), H = prior.information();
  VectorXd g = prior.gradient();
  for (const ScoreBlock& block : fit.blocks) F += block.information, g += block.score;
  H += F;
  H.diagonal() *= 1 + 1e-12;  // what nothing tells
  const MatrixXd covariance = inverse_of(H);
  const VectorXd direction = covariance.col(at), step = -covariance * g;
  if (!(std::abs(step[at]) > kMatters && direction[at] > 0)) return 0;
  double spread = 0;
  for (const ScoreBlock& block : fit.blocks)
    spread += std::pow(direction.dot(block.score + block.information * step), 2);
  const bool few = std::ssize(fit.blocks) < kFewBlocks;
  const double stretch = few ? kUntold : std::max(spread / direction.dot(F * direction), 1.0);
  return step[at] * step[at] / (direction[at] * stretch);
}

// The unknowns of one fit as those of another with the same logs; constants that are new there stand at 0.
VectorXd carried(const FittedFlight& one, const Theta& to) {
  VectorXd u = VectorXd::Zero(to.size());
  const int from = one.theta->constants_count(), count = to.constants_count();
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < from; ++k)
      if (to.name(i) == one.theta->name(k)) u[i] = one.fit.u[k];
  u.tail(to.size() - count) = one.fit.u.tail(one.theta->size() - from);
  return u;
}

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool watches(const FittedFlight& flight, const std::string& name) {
  return std::ranges::any_of(flight.theta->constants(),
                             [&](const FreeConstant& c) { return c.watched && c.name == name; });
}

// How a constant goes with km, which speeds that nobody measured leave open: Omega_0/km and Jp km are told.
double power_of_km(const std::string& name) {
  if (name == kOffset) return -1;
  return name == kRotor ? 1 : 0;
}

bool may_be_nothing(const FittedFlight& flight, const std::string& name, double deviations) {
  const Theta& theta = *flight.theta;
  const VectorXd& u = flight.fit.u;
  VectorXd relative = VectorXd::Zero(u.size());
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    if (c.name == name) relative[i] = theta.slope(u, i) / (theta.physical(u, i) - c.start);
    if (c.index == param::km) relative[i] = power_of_km(name) * theta.slope(u, i) / theta.physical(u, i);
  }
  return !(deviations * deviations * relative.dot(flight.fit.covariance * relative) < 1);
}

void warn_of(const std::vector<std::string>& found, Result& result) {
  if (is_in(found, kOffset))
    result.warn("command_offset",
                "the rotors' speed is not proportional to the command, or the mass or kT as stated is wrong: "
                "Omega_0, their speed at command 0 as the line through the flown commands gives it, is "
                "estimated too");
  if (is_in(found, kDeadTime))
    result.warn("dead_time",
                "rotors follow their commands later or earlier than motors without a dead time would, and "
                "none is stated: dead_time is estimated too, with whatever commands and sensors are apart in "
                "time");
  if (is_in(found, kRotor))
    result.warn("rotor_inertia",
                "rotors that speed up turn the vehicle as they would with inertia, and none is stated: Jp is "
                "estimated too, on which Jzz and kQ depend");
}

bool is_there(const std::string& name, const std::vector<FreeConstant>& constants, const Vehicle& vehicle) {
  const auto is_stated = [&](const std::string& of) {
    return vehicle.has(of) || std::ranges::find(constants, of, &FreeConstant::name) != constants.end();
  };
  return is_stated(name) || (name == kDeadTime && is_stated(kDelay)) ||
         (name == kRotor && is_stated(kMomentum));
}

// Where nothing is known of the inertia about yaw, it takes the place of that of the rotors, and what the one
// leaves of the other's work passes for gusts: then both are free from the start.
bool asks_at_once(const std::vector<FreeConstant>& constants, const Vehicle& vehicle,
                  const FlightRecord& record) {
  const auto Jzz = std::ranges::find(constants, int{param::Jzz}, &FreeConstant::index);
  return record.signals.commands && !is_there(kRotor, constants, vehicle) && Jzz != constants.end() &&
         !Jzz->prior_std;
}

// Adds those of `names` to the constants, held where they are and watched: what the flight says against that
// comes with the fit. Not one that the vehicle states or that is free, nor one that is there as an effect.
void watch(const std::vector<std::string>& names, std::vector<FreeConstant>& constants,
           const Vehicle& vehicle, const FlightRecord& record, const std::vector<double>& p) {
  if (!record.signals.commands) return;
  for (const std::string& name : names) {
    if (is_there(name, constants, vehicle)) continue;
    const std::vector<FreeConstant> all = free_constants(vehicle, p, {name});
    FreeConstant held = *std::ranges::find(all, name, &FreeConstant::name);
    held.watched = true;
    held.prior_value = held.start, held.prior_std = kHeld * held.scale;
    constants.push_back(held);
  }
}

// That of `names` among the watched constants which the logs contradict most, if any by more than
// `beyond_doubt` squared standard deviations: one Newton step from the fit with that one free, against its
// spread over blocks of time.
std::optional<std::string> contradicted(const Theta& theta, const FlightFit& fit,
                                        const std::vector<std::string>& names, double beyond_doubt) {
  std::optional<std::string> found;
  double most = beyond_doubt;
  for (Eigen::Index at = 0; at < theta.constants_count(); ++at) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(at)];
    if (!c.watched || !is_in(names, c.name)) continue;
    const double beyond = contradiction(theta, fit, at);
    if (beyond > most) most = beyond, found = c.name;
  }
  return found;
}

}  // namespace

FittedFlight fit_and_watch(const Vehicle& vehicle, const std::vector<double>& p, const FlightRecord& record,
                           std::vector<FreeConstant> constants, const WatchOptions& options, Result& result) {
  FlightFitOptions fit_options;
  fit_options.progress = options.progress;
  fit_options.steps = Steps::longest;  // on the way to its exact end
  std::vector<std::string> watched = options.watched, found;
  const auto theta_of = [&](std::vector<FreeConstant> of) {
    watch(watched, of, vehicle, record, p);
    return std::make_unique<Theta>(p, std::move(of), record.logs, record.signals.rates);
  };
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> also = options.also;
    also.insert(also.end(), more.begin(), more.end());
    return theta_of(free_constants(vehicle, p, also));
  };
  FittedFlight one;
  const auto fit = [&](std::unique_ptr<Theta> theta) {
    one.theta = std::move(theta);
    one.fit = fit_flight(record, *one.theta, fit_options);
  };
  bool asked_at_once = false;
  if (is_in(watched, kRotor) && asks_at_once(constants, vehicle, record)) try {
      fit(with({kRotor}));
      found = {kRotor}, asked_at_once = true;
    } catch (const DataError&) {  // nothing flies with it
    }
  if (found.empty()) fit(theta_of(std::move(constants)));
  const auto refitted = [&](const std::vector<std::string>& more,
                            bool from_here) -> std::optional<FittedFlight> {
    FittedFlight other{with(more), {}};
    fit_options.start = {}, fit_options.noise.reset();
    if (from_here) {
      fit_options.start = carried(one, *other.theta), fit_options.noise = one.fit.noise;
      fit_options.noise->axes = GustAxes::world;
    }
    try {
      other.fit = fit_flight(record, *other.theta, fit_options);
    } catch (const DataError&) {  // nothing flies with it
      return {};
    }
    return other;
  };
  const auto free = [&](const std::string& name) {
    std::vector<std::string> more = found;
    more.push_back(name);
    auto other = refitted(more, true);
    if (!other) other = refitted(more, false);
    if (other) {
      one = std::move(*other), found = std::move(more);
      return;
    }
    std::erase(watched, name);
    result.warn("contradicted", "the logs contradict " + name +
                                    " as it is where nobody states it, but nothing flies with another one: "
                                    "of what depends on it nothing certain is said");
  };
  const auto against = [&](bool of_yaw) {
    std::vector<std::string> names = watched;
    std::erase_if(names, [&](const std::string& name) { return (name == kRotor) != of_yaw; });
    return contradicted(*one.theta, one.fit, names, of_yaw ? kBeyondDoubtOfYaw : kBeyondDoubt);
  };
  // Of what was found, while something else was still missing perhaps; it is asked no more.
  const auto drop_one = [&] {
    const auto name = std::ranges::find_if(found, [&](const std::string& of) {
      const bool unasked = asked_at_once && of == kRotor;
      return may_be_nothing(one, of, unasked ? std::sqrt(kBeyondDoubtOfYaw) : kByChance);
    });
    if (name == found.end()) return false;
    std::vector<std::string> less = found;
    std::erase(less, *name), std::erase(watched, *name);
    auto other = refitted(less, true);
    if (other) one = std::move(*other), found = std::move(less);
    return other.has_value();
  };
  for (;;) {
    if (const auto name = against(false)) {
      free(*name);
    } else if (is_in(watched, kOffset) && watches(one, kOffset) &&
               steady_push(record, one.fit).matters(vehicle.g)) {
      // What stays for the whole flight passes for a gust once noise is that strong: anew, for that noise
      // would hide the offset again.
      std::vector<std::string> more = found;
      more.push_back(kOffset);
      auto other = refitted(more, false);
      if (other && other->fit.smoother->surprise() < one.fit.smoother->surprise() - kBeyondDoubt &&
          !steady_push(record, other->fit).matters(vehicle.g))
        one = std::move(*other), found = std::move(more);
      else
        std::erase(watched, kOffset);
    } else if (const auto yaw = against(true)) {  // last: what is wrong with thrust bends yaw as well
      free(*yaw);
    } else if (!drop_one()) {
      break;
    }
  }
  warn_of(found, result);
  return one;
}

}  // namespace ident
