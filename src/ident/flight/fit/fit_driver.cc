// The rounds of a fit: steps over the reduced system in turn with the noise.
#include "ident/flight/fit/fit_driver.h"

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/flight/fit/fit_covariance.h"
#include "ident/flight/fit/fit_noise.h"

namespace ident {
namespace {

constexpr double kHuber = 4.0;  // standard deviations beyond which a residual counts linearly
// Relative change of a noise level at which the axes of gusts are chosen, and at which many rounds end.
constexpr double kNearly = 0.3;
// Relative change of a noise level at which it is known, and roughly known. Rounds for the process noise
// within each round.
constexpr double kKnownDriver = 0.03, kRoughly = 0.1;
constexpr int kManyRetuned = 9, kRetuned = 6, kFewRetuned = 3;
// Steps before the noise is estimated: what the model misses there would count as noise.
constexpr int kFirstSteps = 4;
// Mean square of the weighted residuals after those steps above which something may be missing for which the
// fit bends, as far as to motors without effect; rounds of noise before the first step of the second start.
constexpr double kMisses = 3.0;
constexpr int kBeforeSteps = 4;
// Mean square of the weighted residuals that is far from any minimum, and the one to which noise is raised
// for the first steps.
constexpr double kFar = 1e4;
constexpr double kCalm = 10.0;
constexpr double kHeldChunk = 0.2, kSureChunk = 0.1;  // lengths of the first chunks, s
// A step that is taken without an evaluation at its start: largest change of a logarithm, share of the
// promised decrease that it may leave, mean square of the weighted residuals where it ends.
constexpr double kBend = 0.3, kHardlyBends = 0.1, kExplained = 1.1;
// Chunks are cut anew when they could be longer by this factor (for speed), or have to be shorter (for
// accuracy).
constexpr double kLonger = 1.5, kShorter = 1.2;
// Decrease of the cost that steps of lower order may feign within chunks and at their ends. At the ends it
// counts against process noise, of which there is next to none in still air; causes then explained a fiftieth
// of it and less: 40 of 2000, 30 of 14000.
constexpr double kOfSteps = 1.0, kOfLinks = 100.0;

using Eigen::VectorXd;

// Mean square of the weighted residuals.
double square_of(const FlightSmoother& smoother) {
  return smoother.reduced().cost / samples_of(smoother.record());
}

// Length of chunks before the noise is known, s. Shorter where attitude or rates are not measured, because
// states drift there.
double first_chunk(const FlightRecord& record) {
  const bool held = record.signals.rates && record.signals.attitude;
  return std::max(held ? kHeldChunk : kSureChunk, 4 * record.interval);
}

// Very far from the minimum steps follow the noise against the priors, at random. Noise as large as the
// residuals of a channel keeps the first steps near the priors; rounds of noise bring it down again.
NoiseModel calmer(const FlightSmoother& smoother) {
  const Moments m = smoother.moments();
  NoiseModel noise = smoother.noise();
  for (std::size_t c = 0; c < kChannels; ++c)
    if (const double square = m.square[c] / m.count[c]; square > kFar && std::isfinite(square))
      noise.sigma[c] *= std::sqrt(square / kCalm);
  return noise;
}

VectorXd start_of(const Theta& theta, const FlightFitOptions& options) {
  return options.start.size() > 0 ? options.start : VectorXd::Zero(theta.size());
}

}  // namespace

Fitting::Fitting(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options)
    : record_(record), theta_(theta), options_(options), u_(start_of(theta, options)), by_(options.steps) {}

void Fitting::begin() {
  set_out();
  if (options_.estimate_noise)
    if (const NoiseModel noise = calmer(*smoother_); noise.sigma != smoother_->noise().sigma)
      start(noise), smoother_->set_gentle(true);
  trust_region(first_steps());
}

void Fitting::begin_with_noise() {
  set_out();
  for (int round = 0; round < kBeforeSteps; ++round) {
    smoother_->linearize(u_, true);
    smoother_->accept();
    if (update_noise(*smoother_, kRetuned) < kNearly) break;
  }
  if (options_.robust) smoother_->set_huber(kHuber);
  trust_region(first_steps());
}

bool Fitting::misses() {
  linearize_at(*smoother_, u_);
  smoother_->accept();
  return square_of(*smoother_) > kMisses || newton_step(*smoother_, u_).fall > kNear;
}

double Fitting::pull() const {
  return theta_.prior(u_).residual.head(theta_.constants_count()).lpNorm<Eigen::Infinity>();
}

double Fitting::surprise() {
  linearize_at(*smoother_, u_);
  smoother_->accept();
  return smoother_->surprise();
}

bool Fitting::go_on_from(const Fitting& excerpt) {
  serves_ = excerpt.by_;
  u_ = excerpt.u_, chunk_ = excerpt.chunk_, axes_chosen_ = excerpt.axes_chosen_, steps_ = excerpt.steps_;
  by_ = excerpt.by_;
  restart(excerpt.smoother_->noise(), 1, near());
  // An exact fit ends with fine steps, so the noise has to be found with them. No step of the constants yet:
  // from states that have not settled it is worth nothing.
  if (options_.exact) smoother_->set_steps(by_ = Steps::fine);
  if (!(square_of(*smoother_) < kFar)) {
    u_ = start_of(theta_, options_), axes_chosen_ = false, steps_ = 0;
    return false;
  }
  return gone_on_ = true;
}

void Fitting::find_noise(const std::function<void(double)>& tell) {
  bool looked_at = false;  // where this round begins
  for (int round = 0; round < options_.noise_rounds; ++round) {
    if (!looked_at) smoother_->linearize(u_, true);
    looked_at = false;
    smoother_->set_gentle(false);
    smoother_->accept();
    if (options_.robust) smoother_->set_huber(kHuber);
    const NoiseModel before = smoother_->noise();
    const int rounds = options_.rough_noise ? (gone_on_ ? kFewRetuned : kRetuned) : kManyRetuned;
    const double change = update_noise(*smoother_, rounds);
    const double wanted =
        options_.chunk_seconds > 0 ? chunk_ : chunk_for(record_, smoother_->noise(), options_.fine_gusts);
    if (round < 2 && (wanted > kLonger * chunk_ || wanted < chunk_ / kShorter)) {
      chunk_ = wanted;
      restart(smoother_->noise(), 2, smoother_.get());
    }
    tell(static_cast<double>(round + 1) / options_.noise_rounds);
    const bool known =
        change < (options_.rough_noise ? kRoughly : kKnownDriver) || (round >= 5 && change < kNearly);
    bool turned = false;
    if (options_.choose_axes && !axes_chosen_ && !axes_asked_ &&
        (known || (change < kNearly && newton_step(*smoother_, u_).fall < kNear * theta_.size()))) {
      axes_asked_ = true, axes_chosen_ = choose_axes(*smoother_, u_);
      turned = smoother_->noise().axes != GustAxes::world;
    }
    const NewtonStep step = newton_step(*smoother_, u_);
    smoother_->accept();
    const bool done = known && !turned;
    if (done && !(step.fall < kNear * theta_.size())) break;
    if ((done || step.fall < kNear) && is_short(theta_, u_, step.du)) {
      u_ += step.du;
    } else if (!done && change < kNearly && !options_.rough_noise && steps_far(step)) {
      looked_at = true;
    } else if (is_finite(smoother_->linearize(u_))) {
      trust_region({.tolerance = 0.1, .near = kNear, .max_steps = 1, .leverage = true});
      looked_at = smoother_->has_leverages_at(u_);
    } else {  // a sensor that seems to have no noise at all
      restart(before);
      break;
    }
    if (done) break;
  }
  if (looked_at) smoother_->accept();
}

// A step from far away that ends where the next round of noise begins. It is taken where the model then
// misses nothing but noise and was nearly linear on the way; any other step is left to the trust region,
// which evaluates twice.
bool Fitting::steps_far(const NewtonStep& step) {
  if (!is_short(theta_, u_, step.du / kBend)) return false;
  const VectorXd to = u_ + step.du;
  if (!theta_.possible(to) || !is_finite(smoother_->linearize(to, true)) ||
      square_of(*smoother_) > kExplained)
    return false;
  if (!(newton_step(*smoother_, to).fall < kHardlyBends * step.fall)) return false;
  u_ = to, ++steps_;
  return true;
}

bool Fitting::steps_show(double times) {
  bool shown = false;
  serves_ = by_;
  // An exact fit ends with fine steps anyway: only the rows count for it.
  const auto show = [&] {
    const FlightSmoother::WorthOfSteps worth = smoother_->worth_of_fine_steps();
    return times * worth.rows > kOfSteps || (!options_.exact && times * worth.links > kOfLinks);
  };
  while (by_ != Steps::fine && show()) {
    shown = true;
    by_ = by_ == Steps::longest ? Steps::coarse : Steps::fine;
    smoother_->set_steps(by_), serves_ = by_;
  }
  return shown;
}

FlightFit Fitting::finish() {
  if (gave_up()) return unfinished();
  smoother_->set_gentle(false);
  if (options_.exact) smoother_->set_steps(Steps::fine);
  // Far from any minimum states may have been sent where the simulation diverges. Gross errors count linearly
  // and do not call them back: start again from the measured states.
  if (!is_finite(linearize_at(*smoother_, u_)) || is_lost()) restart(smoother_->noise());
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
  const bool lost = !fit.covariance.allFinite() || !(fit.cost < kFar * samples_of(record_));
  if (options_.estimate_noise && lost)
    throw DataError(
        "the fit does not come to rest: states run away from what was measured; state more of the "
        "constants in the vehicle file, or give another part of the log");
  return fit;
}

bool Fitting::is_lost() const { return options_.estimate_noise && !(square_of(*smoother_) < kFar); }

TrustRegion Fitting::first_steps() const {
  TrustRegion first{.tolerance = 1.0, .near = kNear, .free = false};
  if (options_.estimate_noise) first.max_steps = kFirstSteps;
  if (options_.most_steps > 0) first.max_steps = std::min(first.max_steps, options_.most_steps);
  return first;
}

FlightFit Fitting::unfinished() const {
  FlightFit fit;
  fit.u = u_, fit.steps = steps_, fit.noise = smoother_->noise(), fit.chunk_seconds = chunk_;
  return fit;
}

void Fitting::set_out() {
  const NoiseModel noise = options_.noise.value_or(initial_noise(record_));
  chunk_ = options_.chunk_seconds > 0 ? options_.chunk_seconds : first_chunk(record_);
  start(noise);
  if (options_.chunk_seconds <= 0 && !(square_of(*smoother_) < kFar)) {
    chunk_ = std::max(kSureChunk, 4 * record_.interval);
    start(noise);
  }
  smoother_->set_gentle(true);
}

void Fitting::start(const NoiseModel& noise) {
  smoother_ = std::make_shared<FlightSmoother>(record_, theta_, noise, chunk_, options_.threads);
  smoother_->set_steps(by_);
  // Gross errors count linearly only once the model is near: far away everything looks gross.
  smoother_->set_huber(options_.estimate_noise || !options_.robust ? 1e9 : kHuber);
  if (near()) smoother_->start_from(*near());
  smoother_->settle(u_, 1);
}

void Fitting::restart(const NoiseModel& noise, int rounds, const FlightSmoother* from) {
  auto next = std::make_shared<FlightSmoother>(record_, theta_, noise, chunk_, options_.threads);
  next->set_steps(by_);
  next->set_huber(options_.robust ? kHuber : 1e9);
  if (from) next->start_from(*from);
  smoother_ = std::move(next);
  smoother_->settle(u_, rounds);
}

const FlightSmoother* Fitting::near() const {
  return options_.near && &options_.near->record() == &record_ ? options_.near.get() : nullptr;
}

void Fitting::trust_region(const TrustRegion& region) {
  const SharedMinimum at = by_trust_region(*smoother_, u_, region);
  u_ = at.u, steps_ += at.steps;
}

}  // namespace ident
