// Score tests of Omega_0, dead_time and Jp, and the fits that follow from them.
#include "ident/flight/fit/extend_by_score_test.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ident/core/error.h"
#include "ident/flight/fit/fit_steps.h"
#include "ident/flight/fit/mean_push.h"
#include "ident/flight/fit/score_test.h"
#include "ident/flight/fit/unstated_constants.h"

namespace ident {

using Eigen::VectorXd;

namespace {

constexpr double kBeyondDoubt = 25.0;       // squared standard deviations, or fall of the cost
constexpr double kBeyondDoubtOfYaw = 16.0;  // for Jp: none of 56 flights without effect reached it
constexpr double kByChance = 2.0;           // standard deviations

// The unknowns of one fit in the order of another one with the same logs; constants that are new there are 0.
VectorXd carried(const FittedFlight& one, const Theta& to) {
  VectorXd u = VectorXd::Zero(to.size());
  const int from = one.theta->constants_count(), count = to.constants_count();
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < from; ++k)
      if (to.name(i) == one.theta->name(k)) u[i] = one.fit.u[k];
  u.tail(to.size() - count) = one.fit.u.tail(one.theta->size() - from);
  return u;
}

bool watches(const FittedFlight& flight, const std::string& name) {
  return std::ranges::any_of(flight.theta->constants(),
                             [&](const FreeConstant& c) { return c.watched && c.name == name; });
}

bool is_negative(const FittedFlight& flight, const std::string& name) {
  for (int i = 0; i < flight.theta->constants_count(); ++i)
    if (flight.theta->name(i) == name) return flight.theta->physical(flight.fit.u, i) < 0;
  return false;
}

// The watched constant among `names` that the logs contradict most, if by more than `beyond_doubt` squared
// standard deviations.
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

// A fit with the watched constants that it had to free.
class WatchedFit {
 public:
  WatchedFit(const Vehicle& vehicle, const std::vector<double>& p, const FlightRecord& record,
             const WatchOptions& options, Result& result)
      : vehicle_(vehicle),
        p_(p),
        record_(record),
        also_(options.also),
        result_(result),
        watched_(options.watched) {
    fit_options_.progress = options.progress;
    fit_options_.steps = Steps::longest;  // until its exact end
  }

  // The first fit. Where the simulation diverges with all watched constants held, one of them is freed at
  // once.
  void begin(std::vector<FreeConstant> constants) {
    for (const FreeConstant& c : constants) base_.push_back(c.name);
    const bool at_once = is_in(watched_, kRotor) && asks_at_once(constants, vehicle_, record_);
    if (at_once && begins_with(kRotor)) return;
    std::vector<std::string> left;
    for (const std::string& name : {kRotor, kDeadTime})
      if (is_in(watched_, name) && !(at_once && name == kRotor) && can_show(name, record_.signals) &&
          !is_there(name, constants, vehicle_))
        left.push_back(name);
    try {
      fit(theta_of(std::move(constants)));
    } catch (const DataError&) {
      if (std::ranges::none_of(left, [&](const std::string& name) { return begins_with(name); })) throw;
    }
  }

  // Frees or holds one constant; returns whether anything changed.
  bool step() {
    if (const auto name = against(false)) {
      free(*name);
      if (!tried_alone_ && is_in(found_, kDeadTime) &&
          (is_in(found_, kOffset) || is_negative(one_, kDeadTime)))
        try_delay_alone();
    } else if (is_in(watched_, kOffset) && watches(one_, kOffset) &&
               steady_push(record_, one_.fit).matters(vehicle_.g)) {
      try_offset();
    } else if (const auto yaw = against(true)) {  // last: what is wrong with thrust bends yaw as well
      free(*yaw);
    } else {
      return drop_one();
    }
    return true;
  }

  FittedFlight end() {
    warn_of_found(found_, result_);
    return std::move(one_);
  }

 private:
  std::unique_ptr<Theta> theta_of(std::vector<FreeConstant> of) const {
    watch(watched_, of, vehicle_, record_, p_);
    return std::make_unique<Theta>(p_, std::move(of), record_.logs, record_.signals.rates);
  }

  bool begins_with(const std::string& name) {
    try {
      fit(with({name}));
    } catch (const DataError&) {  // nothing flies with it
      return false;
    }
    found_ = {name}, unasked_ = name;
    return true;
  }

  std::unique_ptr<Theta> with(const std::vector<std::string>& more) const {
    std::vector<std::string> also = also_;
    also.insert(also.end(), more.begin(), more.end());
    std::vector<FreeConstant> all = free_constants(vehicle_, p_, also);
    if (!record_.signals.commands)
      std::erase_if(all,
                    [&](const FreeConstant& c) { return !is_in(base_, c.name) && !is_in(also, c.name); });
    return theta_of(std::move(all));
  }

  void fit(std::unique_ptr<Theta> theta) {
    one_.theta = std::move(theta);
    one_.fit = fit_flight(record_, *one_.theta, fit_options_);
  }

  std::optional<FittedFlight> refitted(const std::vector<std::string>& more, bool from_here) {
    FittedFlight other{with(more), {}};
    fit_options_.start = {}, fit_options_.noise.reset();
    if (from_here) {
      fit_options_.start = carried(one_, *other.theta), fit_options_.noise = one_.fit.noise;
      fit_options_.noise->axes = GustAxes::world;
    }
    try {
      other.fit = fit_flight(record_, *other.theta, fit_options_);
    } catch (const DataError&) {  // nothing flies with it
      return {};
    }
    return other;
  }

  std::vector<std::string> found_and(const std::string& name) const {
    std::vector<std::string> more = found_;
    more.push_back(name);
    return more;
  }

  void free(const std::string& name) {
    std::vector<std::string> more = found_and(name);
    auto other = refitted(more, true);
    if (!other) other = refitted(more, false);
    if (other) {
      one_ = std::move(*other), found_ = std::move(more);
      return;
    }
    std::erase(watched_, name);
    result_.warn(
        "contradicted",
        "The logs contradict the default of " + name +
            ", which is not stated, and no flight can be simulated with another value. Constants that "
            "depend on it are not identifiable. State it from a bench.");
  }

  // A push that lasts for the whole flight counts as gusts once the noise is that strong. So start anew: that
  // noise would hide the offset again.
  void try_offset() {
    std::vector<std::string> more = found_and(kOffset);
    auto other = refitted(more, false);
    if (other && other->fit.smoother->surprise() < one_.fit.smoother->surprise() - kBeyondDoubt &&
        !steady_push(record_, other->fit).matters(vehicle_.g))
      one_ = std::move(*other), found_ = std::move(more);
    else
      std::erase(watched_, kOffset);
  }

  // Commands that are logged late first ask for motors without a lag, from there for an offset, and only then
  // for a delay. With the delay from the beginning no offset may be needed.
  void try_delay_alone() {
    tried_alone_ = true;
    std::vector<std::string> alone = found_;
    std::erase(alone, kOffset);
    auto other = refitted(alone, false);
    if (other && other->fit.smoother->surprise() < one_.fit.smoother->surprise())
      one_ = std::move(*other), found_ = std::move(alone);
  }

  std::optional<std::string> against(bool of_yaw) const {
    std::vector<std::string> names = watched_;
    std::erase_if(names, [&](const std::string& name) { return (name == kRotor) != of_yaw; });
    return contradicted(*one_.theta, one_.fit, names, of_yaw ? kBeyondDoubtOfYaw : kBeyondDoubt);
  }

  // Holds one freed constant again that may be nothing; it is not asked for any more.
  bool drop_one() {
    const auto name = std::ranges::find_if(found_, [&](const std::string& of) {
      return may_be_nothing(*one_.theta, one_.fit, of,
                            of == unasked_ ? std::sqrt(kBeyondDoubtOfYaw) : kByChance);
    });
    if (name == found_.end()) return false;
    std::vector<std::string> less = found_;
    std::erase(less, *name), std::erase(watched_, *name);
    auto other = refitted(less, true);
    if (other) one_ = std::move(*other), found_ = std::move(less);
    return other.has_value();
  }

  const Vehicle& vehicle_;
  const std::vector<double>& p_;
  const FlightRecord& record_;
  const std::vector<std::string>& also_;
  Result& result_;
  FlightFitOptions fit_options_;
  std::vector<std::string> watched_, found_, base_;
  FittedFlight one_;
  bool tried_alone_ = false;
  std::string unasked_;  // free from the beginning without a test
};

}  // namespace

FittedFlight fit_and_watch(const Vehicle& vehicle, const std::vector<double>& p, const FlightRecord& record,
                           std::vector<FreeConstant> constants, const WatchOptions& options, Result& result) {
  WatchedFit fit(vehicle, p, record, options, result);
  fit.begin(std::move(constants));
  while (fit.step()) {
  }
  return fit.end();
}

}  // namespace ident
