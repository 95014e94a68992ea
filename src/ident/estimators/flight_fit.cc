// Ceres over the reduced system, in turn with the noise.
#include "ident/estimators/flight_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "ident/core/error.h"
#include "ident/estimators/flight_fit_steps.h"

namespace ident {
namespace {

constexpr double kHuber = 4.0;  // standard deviations beyond which a residual counts linearly
// Change of a noise level that is good enough to choose the axes of gusts, and after many rounds to stop.
constexpr double kNearly = 0.3;
// Change of a noise level at which it is known, and roughly known; rounds for the air's in each round.
constexpr double kKnown = 0.03, kRoughly = 0.1;
constexpr int kRetuned = 6, kFewRetuned = 3;
// Steps before noise is estimated: what the model misses there would pass for noise.
constexpr int kFirstSteps = 4;
// A mean square of residuals, in variances, that those steps leave, or further steps of such length, where
// something may be missing that the model bends for, as far as to motors that do nothing; deviations of a
// constant that is; rounds of noise before the first step of a fit that keeps from it.
constexpr double kMisses = 3.0, kBent = 5.0;
constexpr int kBeforeSteps = 4;
// A mean square of residuals, in variances, so large that the model is far from any minimum, and what is made
// of it for the first steps.
constexpr double kFar = 1e4;
constexpr double kCalm = 10.0;
constexpr double kHeldChunk = 0.2, kSureChunk = 0.1;  // lengths of the first chunks, s
// Records longer than this, s, are begun on so much of them, in stretches of so many seconds: rounds of noise
// are most of a fit, and few are left once it is nearly known.
constexpr double kLong = 30.0, kExcerpt = 15.0, kStretch = 4.0;
constexpr double kLeastShare = 0.1, kMostShare = 0.25;
// Fall of the cost that steps of lower order may feign.
constexpr double kOfSteps = 1.0;
constexpr double kMostCalm = 1e4;  // times the variance: few rounds of noise bring that down again

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Tell = std::function<void(double)>;

// Mean square of the residuals, in variances.
double square_of(const FlightSmoother& smoother) {
  return smoother.reduced().cost / samples_of(smoother.record());
}

// Chunks before the noise is known, s. Where attitude or rates are not measured, states drift from what
// little holds them.
double first_chunk(const FlightRecord& record) {
  const bool held = record.signals.rates && record.signals.attitude;
  return std::max(held ? kHeldChunk : kSureChunk, 4 * record.interval);
}

// Very far from the minimum, steps follow what noise there is against everything that was known beforehand,
// to where chance takes them. Noise as large as the residuals lets the first ones keep to it; rounds of noise
// bring it down again.
void calm(FlightSmoother& smoother) {
  const double square = square_of(smoother);
  if (!(square > kFar) || !std::isfinite(square)) return;
  NoiseModel noise = smoother.noise();
  for (double& sigma : noise.sigma) sigma *= std::sqrt(std::min(square / kCalm, kMostCalm));
  smoother.set_noise(noise);
}

VectorXd start_of(const Theta& theta, const FlightFitOptions& options) {
  return options.start.size() > 0 ? options.start : VectorXd::Zero(theta.size());
}

// One fit on its way: shared unknowns, noise and chunks over a record or an excerpt of it.
class Fitting {
 public:
  Fitting(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options)
      : record_(record), theta_(theta), options_(options), u_(start_of(theta, options)), by_(options.steps) {}

  /// From what was measured and stated.
  void begin() {
    chunk_ = options_.chunk_seconds > 0 ? options_.chunk_seconds : first_chunk(record_);
    start();
    if (options_.chunk_seconds <= 0 && !(square_of(*smoother_) < kFar)) {
      chunk_ = std::max(kSureChunk, 4 * record_.interval);
      start();
    }
    if (options_.estimate_noise) calm(*smoother_);
    smoother_->set_gentle(true);
    trust_region(first_steps());
  }

  /// The same, after rounds of noise at what was stated.
  void begin_with_noise() {
    chunk_ = options_.chunk_seconds > 0 ? options_.chunk_seconds : first_chunk(record_);
    start();
    smoother_->set_gentle(true);
    for (int round = 0; round < kBeforeSteps; ++round) {
      smoother_->linearize(u_, true);
      smoother_->accept();
      if (update_noise(*smoother_, kRetuned) < kNearly) break;
    }
    if (options_.robust) smoother_->set_huber(kHuber);
    trust_region(first_steps());
  }

  /// Whether it is not near a minimum, or misses more than noise.
  bool misses() {
    linearize_at(*smoother_, u_);
    smoother_->accept();
    return square_of(*smoother_) > kMisses || newton_step(*smoother_, u_).fall > kNear;
  }

  /// The farthest that a constant is from what was stated, in deviations.
  double pull() const {
    return theta_.prior(u_).residual.head(theta_.constants_count()).lpNorm<Eigen::Infinity>();
  }

  /// Of its noise and unknowns: the less the likelier.
  double surprise() {
    linearize_at(*smoother_, u_);
    smoother_->accept();
    return smoother_->surprise();
  }

  /// From where the fit of an excerpt ended; false where that is far from anything here.
  bool go_on_from(const Fitting& excerpt) {
    serves_ = excerpt.by_;
    u_ = excerpt.u_, chunk_ = excerpt.chunk_, axes_chosen_ = excerpt.axes_chosen_, steps_ = excerpt.steps_;
    // The end has to be of fine steps: what is found here by others would have to be found once more.
    by_ = options_.exact ? Steps::fine : excerpt.by_;
    restart(excerpt.smoother_->noise(), 1, near());
    if (!(square_of(*smoother_) < kFar)) {
      u_ = start_of(theta_, options_), axes_chosen_ = false, steps_ = 0;
      return false;
    }
    const NewtonStep step = newton_step(*smoother_, u_);
    if (step.fall < kNear * theta_.size() && is_short(theta_, u_, step.du)) u_ += step.du;
    return gone_on_ = true;
  }

  /// Noise and unknowns in turn. Chunks may change in the first two rounds.
  void find_noise(const Tell& tell) {
    for (int round = 0; round < options_.noise_rounds; ++round) {
      smoother_->linearize(u_, true);
      smoother_->set_gentle(false);
      smoother_->accept();
      if (options_.robust) smoother_->set_huber(kHuber);
      const NoiseModel before = smoother_->noise();
      const double change =
          update_noise(*smoother_, options_.rough_noise && gone_on_ ? kFewRetuned : kRetuned);
      const double wanted =
          options_.chunk_seconds > 0 ? chunk_ : chunk_for(record_, smoother_->noise(), options_.fine_gusts);
      if (round < 2 && (wanted > 1.5 * chunk_ || wanted < chunk_ / 1.5)) {
        chunk_ = wanted;
        restart(smoother_->noise(), 2, smoother_.get());
      }
      tell(static_cast<double>(round + 1) / options_.noise_rounds);
      bool turned = false;
      if (options_.choose_axes && !axes_chosen_ && !axes_asked_ && change < kNearly) {
        axes_asked_ = true, axes_chosen_ = choose_axes(*smoother_, u_);
        turned = smoother_->noise().axes != GustAxes::world;
      }
      const NewtonStep step = newton_step(*smoother_, u_);
      smoother_->accept();
      const bool done = !turned && (change < (options_.rough_noise ? kRoughly : kKnown) ||
                                    (round >= 5 && change < kNearly));
      if (done && !(step.fall < kNear * theta_.size())) break;
      if ((done || step.fall < kNear) && is_short(theta_, u_, step.du)) {
        u_ += step.du;
      } else if (is_finite(smoother_->linearize(u_))) {
        trust_region({.tolerance = 0.1, .near = kNear, .max_steps = 1});
      } else {  // a sensor that seems to have no noise at all
        restart(before);
        break;
      }
      if (done) break;
    }
  }

  /// Whether there is so little noise that it shows how flight is simulated, in `times` as much flight; by
  /// finer steps from then on.
  bool steps_show(double times = 1.0) {
    bool shown = false;
    serves_ = by_;
    while (by_ != Steps::fine && times * smoother_->worth_of_fine_steps() > kOfSteps) {
      shown = true;
      by_ = by_ == Steps::longest ? Steps::coarse : Steps::fine;
      smoother_->set_steps(by_), serves_ = by_;
    }
    return shown;
  }

  FlightFit finish() {
    if (gave_up()) return unfinished();
    smoother_->set_gentle(false);
    if (options_.exact) smoother_->set_steps(Steps::fine);
    // Far from any minimum states may have been sent where nothing flies: back to what was measured then.
    if (!is_finite(linearize_at(*smoother_, u_))) restart(smoother_->noise());
    const SharedMinimum at = minimise_shared(*smoother_, u_, worth_a_step(*smoother_, options_),
                                             options_.most_steps > 0 ? options_.most_steps - steps_ : 0);
    u_ = at.u, steps_ += at.steps;
    if (gave_up()) return unfinished();
    FlightFit fit;
    fit.u = u_, fit.steps = steps_;
    fit.noise = smoother_->noise();
    fit.chunk_seconds = chunk_;
    fit.smoother = smoother_;
    fit.converged = true, fit.serves = serves_;
    finish_fit(fit, theta_, options_, true);
    return fit;
  }

 private:
  TrustRegion first_steps() const {
    TrustRegion first{.tolerance = 1.0, .near = kNear, .free = false};
    if (options_.estimate_noise) first.max_steps = kFirstSteps;
    if (options_.most_steps > 0) first.max_steps = std::min(first.max_steps, options_.most_steps);
    return first;
  }
  bool gave_up() const { return options_.most_steps > 0 && steps_ >= options_.most_steps; }
  FlightFit unfinished() const {
    FlightFit fit;
    fit.u = u_, fit.steps = steps_, fit.noise = smoother_->noise(), fit.chunk_seconds = chunk_;
    return fit;
  }
  void start() {
    smoother_ = std::make_shared<FlightSmoother>(
        record_, theta_, options_.noise.value_or(initial_noise(record_)), chunk_, options_.threads);
    smoother_->set_steps(by_);
    // Gross errors count linearly, but only once the model is near: far from it everything looks gross.
    smoother_->set_huber(options_.estimate_noise || !options_.robust ? 1e9 : kHuber);
    if (near()) smoother_->start_from(*near());
    smoother_->settle(u_, 1);
  }
  // From the states that were measured, or those of `from`.
  void restart(const NoiseModel& noise, int rounds = 2, const FlightSmoother* from = nullptr) {
    auto next = std::make_shared<FlightSmoother>(record_, theta_, noise, chunk_, options_.threads);
    next->set_steps(by_);
    next->set_huber(options_.robust ? kHuber : 1e9);
    if (from) next->start_from(*from);
    smoother_ = std::move(next);
    smoother_->settle(u_, rounds);
  }
  // What there is of a like model, over the same record.
  const FlightSmoother* near() const {
    return options_.near && &options_.near->record() == &record_ ? options_.near.get() : nullptr;
  }
  void trust_region(const TrustRegion& region) {
    const SharedMinimum at = by_trust_region(*smoother_, u_, region);
    u_ = at.u, steps_ += at.steps;
  }

  const FlightRecord& record_;
  const Theta& theta_;
  const FlightFitOptions& options_;
  VectorXd u_;
  std::shared_ptr<FlightSmoother> smoother_;
  Steps by_;  // which flight is simulated
  Steps serves_ = Steps::fine;
  double chunk_ = 0.0;
  int steps_ = 0;
  bool gone_on_ = false;                           // from an excerpt, which knew the noise
  bool axes_asked_ = false, axes_chosen_ = false;  // here; beyond doubt
};

// Whether every log that flies is in an excerpt.
bool of_every_log(const FlightRecord& excerpt, const FlightRecord& record) {
  return std::ranges::all_of(record.arcs, [&](const FlightArc& arc) {
    return std::ranges::find(excerpt.arcs, arc.log, &FlightArc::log) != excerpt.arcs.end();
  });
}

// A fit begun, its noise found if that is asked for. Where the first steps do not come near, the likelier of
// two: that one, and one that knew what the model does not explain before it took any. In a search for what
// is missing this one also where the other is bent for it.
std::unique_ptr<Fitting> started(const FlightRecord& record, const Theta& theta,
                                 const FlightFitOptions& options, const Tell& tell) {
  auto fit = std::make_unique<Fitting>(record, theta, options);
  fit->begin();
  if (!options.estimate_noise) return fit;
  const bool misses = fit->misses();
  fit->find_noise(tell);
  if (misses) try {
      auto other = std::make_unique<Fitting>(record, theta, options);
      other->begin_with_noise();
      other->find_noise(tell);
      const double by_steps = fit->surprise(), by_noise = other->surprise();
      const bool likelier = !(by_steps <= by_noise);
      const bool bends_less = fit->pull() > kBent && other->pull() < fit->pull();
      if (std::isfinite(by_noise) && (likelier || (options.rough_noise && bends_less))) return other;
    } catch (const DataError&) {  // nothing flies from there
    }
  return fit;
}

}  // namespace

FlightFit fit_flight(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options) {
  const auto tell = [&](double from, double to) {
    return [&options, from, to](double share) {
      if (options.progress) options.progress(from + share * (to - from));
    };
  };
  auto fitting = std::make_unique<Fitting>(record, theta, options);
  bool begun = false;
  if (options.estimate_noise && record.duration > kLong) {
    const double share = std::clamp(kExcerpt / record.duration, kLeastShare, kMostShare);
    if (const FlightRecord excerpt = excerpt_of(record, share, kStretch); of_every_log(excerpt, record)) try {
        const std::unique_ptr<Fitting> first = started(excerpt, theta, options, tell(0.1, 0.4));
        first->steps_show(record.duration / excerpt.duration);
        begun = fitting->go_on_from(*first);
      } catch (const DataError&) {  // too little of it to be simulated; the whole may be
      }
  }
  if (begun)
    fitting->find_noise(tell(0.4, 0.8));
  else
    fitting = started(record, theta, options, tell(0.4, 0.8));
  if (options.estimate_noise && !begun && fitting->steps_show()) fitting->find_noise(tell(0.6, 0.8));
  FlightFit fit = fitting->finish();
  tell(0, 1)(1.0);
  return fit;
}

}  // namespace ident
