// Fits a flight: first an excerpt, then all of it.
#include "ident/flight/fit/fit.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <memory>

#include "ident/core/error.h"
#include "ident/core/stage_times.h"
#include "ident/flight/fit/fit_driver.h"
#include "ident/flight/record/excerpts.h"

namespace ident {
namespace {

// Records longer than kLong seconds are begun on kExcerpt seconds of them, in stretches of kStretch seconds.
// Most of the time of a fit goes into rounds of noise, and few are needed once the noise is nearly known.
constexpr double kLong = 30.0, kExcerpt = 15.0, kStretch = 4.0;
constexpr double kLeastShare = 0.1, kMostShare = 0.25;
// Distance from its prior, in standard deviations, of a constant that is bent by something missing.
constexpr double kBent = 5.0;

using Tell = std::function<void(double)>;

// Whether every log of a record is in its excerpt.
bool of_every_log(const FlightRecord& excerpt, const FlightRecord& record) {
  return std::ranges::all_of(record.arcs, [&](const FlightArc& arc) {
    return std::ranges::find(excerpt.arcs, arc.log, &FlightArc::log) != excerpt.arcs.end();
  });
}

// Begins a fit and finds its noise if asked to. Where the first steps end far from a minimum, a second fit is
// begun that estimates the noise before its first step, and the likelier of the two is returned. Where the
// first one diverges, the second is. In a search of a diagnosis the second also wins where the first has bent
// a constant.
std::unique_ptr<Fitting> started(const FlightRecord& record, const Theta& theta,
                                 const FlightFitOptions& options, const Tell& tell) {
  auto fit = std::make_unique<Fitting>(record, theta, options);
  bool misses = false;
  std::exception_ptr ran_away;
  try {
    fit->begin();
    if (!options.estimate_noise) return fit;
    misses = fit->misses();
    fit->find_noise(tell);
  } catch (const DataError&) {
    if (!options.estimate_noise) throw;
    ran_away = std::current_exception();
  }
  if (!misses && !ran_away) return fit;
  try {
    auto other = std::make_unique<Fitting>(record, theta, options);
    other->begin_with_noise();
    other->find_noise([](double) {});
    const double by_noise = other->surprise();
    if (std::isfinite(by_noise)) {
      if (ran_away) return other;
      const double by_steps = fit->surprise();
      const bool likelier = !(by_steps <= by_noise);
      const bool bends_less = fit->pull() > kBent && other->pull() < fit->pull();
      if (likelier || (options.rough_noise && bends_less)) return other;
    }
  } catch (const DataError&) {  // the simulation diverges from there
  }
  if (ran_away) std::rethrow_exception(ran_away);
  return fit;
}

}  // namespace

FlightFit fit_flight(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options) {
  const Stage stage("fit of a model");
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
      } catch (const DataError&) {  // the excerpt cannot be simulated; the whole may be
      }
  }
  if (begun) try {
      fitting->find_noise(tell(0.4, 0.8));
    } catch (const DataError&) {  // the rest diverges where the excerpt led
      begun = false;
    }
  if (!begun) fitting = started(record, theta, options, tell(0.4, 0.8));
  if (options.estimate_noise && !begun && fitting->steps_show()) fitting->find_noise(tell(0.6, 0.8));
  FlightFit fit = fitting->finish();
  tell(0, 1)(1.0);
  return fit;
}

}  // namespace ident
