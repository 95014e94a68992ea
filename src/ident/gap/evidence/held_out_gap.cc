// Predictions of held-out flight by the model as given and by the model found.
#include "ident/gap/evidence/held_out_gap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ident/core/stage_times.h"
#include "ident/flight/fit/fit_covariance.h"
#include "ident/flight/record/excerpts.h"
#include "ident/gap/evidence/motion_errors.h"
#include "ident/gap/hypotheses/cause_alone.h"
#include "ident/result/json_number.h"

namespace ident {
namespace {

nlohmann::ordered_json as_json(const GapClosed& gap) {
  return {{"before", number_or_null(gap.before)},
          {"after", number_or_null(gap.after)},
          {"noise_floor", number_or_null(gap.floor)},
          {"closed", number_or_null(gap.closed)},
          {"closed_ci95", {number_or_null(gap.ci95[0]), number_or_null(gap.ci95[1])}}};
}

// Three channels of one quantity, and the unit in which a reader knows it.
struct Quantity {
  const char *name, *unit;
  int first;
  double per_SI;
};
constexpr std::array kQuantities = {
    Quantity{"velocity", "m/s", kVelocity, 1.0}, Quantity{"position", "m", kPosition, 1.0},
    Quantity{"rates", "rad/s", kGyro, 1.0}, Quantity{"attitude", "deg", kAttitude, 180 / M_PI}};

// Root mean square, over windows and samples, of what those channels are missed by (or of its floor).
double missed(const std::vector<PredictionWindow>& windows, const Quantity& q, const NoiseModel& noise,
              std::array<double, kChannels> PredictionWindow::*of) {
  double sum = 0, count = 0;
  for (const PredictionWindow& w : windows)
    for (int c = q.first; c < q.first + 3; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      sum += (w.*of)[channel] * std::pow(noise.sigma[channel], 2), count += w.count[channel];
    }
  return count > 0 ? q.per_SI * std::sqrt(3 * sum / count) : kNaN;  // of the vector
}

// Errors of the channels, from states that were estimated out of the flight before the window.
nlohmann::ordered_json channel_errors(const HeldOutGap& all, const NoiseModel& noise) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (std::size_t h = 0; h < all.windows.horizons.size(); ++h) {
    nlohmann::ordered_json one{{"horizon", all.windows.horizons[h]}};
    for (const Quantity& q : kQuantities) {
      const double before = missed(all.before[h], q, noise, &PredictionWindow::square);
      if (!std::isfinite(before)) continue;
      one[q.name] = {
          {"unit", q.unit},
          {"before", before},
          {"after", number_or_null(missed(all.after[h], q, noise, &PredictionWindow::square))},
          {"noise_floor", number_or_null(missed(all.after[h], q, noise, &PredictionWindow::floor))}};
    }
    out.push_back(one);
  }
  return out;
}

bool has_room(const HeldOutGap& all, double horizon) {
  const double least = all.windows.history + horizon;
  return std::ranges::any_of(all.record.arcs,
                             [&](const FlightArc& arc) { return arc.t.back() - arc.t.front() > least; });
}

ComparedModels compared(const HeldOutGap& all, const SearchResult& search) {
  ComparedModels out{.stated = search.base.theta->p(all.stated),
                     .found = search.best.theta->p(all.found),
                     .sigma = search.form.noise.sigma};
  for (int log = 0; log < all.record.logs; ++log)
    out.gyro_bias.push_back(search.best.theta->gyro_bias(all.found, log));
  return out;
}

// Sets which horizon is judged, and what it shows.
void judge_horizon(HeldOutGap& all) {
  constexpr std::size_t kFewWindows = 10;
  all.judged = all.gap;
  if (has_room(all, kJudgedHorizon)) return;
  const bool pieces = all.windows.horizons[0] < kJudgedHorizon && all.before[0].size() >= kFewWindows;
  if (pieces)
    all.judged_at = 0, all.judged = all.horizons[0];
  else
    all.judged.held_out = false;
}

}  // namespace

HeldOutGap held_out_gap(const FlightRecord& record, const SearchResult& search) {
  const Stage stage("held-out flight");
  HeldOutGap all{.record = held_out_of(record, kTrainingShare)};
  all.windows.steps = search.best.fit.smoother->steps();
  all.found = fit_of_training(search.best.fit, record, *search.best.theta, kTrainingShare);
  // "Before" is the model as it was given: bench values, with the biases of the fit.
  all.stated = search.base.fit.u;
  all.stated.head(search.base.theta->constants_count()).setZero();
  const NoiseModel& noise = search.form.noise;
  all.before =
      predict_windows(all.record, *search.base.theta, all.stated, noise, without_floors(all.windows));
  all.after = predict_windows(all.record, *search.best.theta, all.found, noise, all.windows);
  for (std::size_t h = 0; h < all.windows.horizons.size(); ++h) {
    all.horizons.push_back(gap_closed(all.before[h], all.after[h]));
    if (all.windows.horizons[h] == kJudgedHorizon) all.gap = all.horizons.back(), all.judged_at = h;
  }
  judge_horizon(all);
  return all;
}

GapClosed closed_alone(const HeldOutGap& all, const SearchResult& search, const Candidate& cause) {
  if (search.best.adopted.size() == 1) return all.gap;
  PredictionOptions fewer = all.windows;  // every other one tells causes apart
  fewer.horizons = {all.windows.horizons[1]}, fewer.spacing *= 2;
  const auto alone = predict_windows(all.record, *search.best.theta,
                                     with_only(search.best, all.found, {cause}), search.form.noise, fewer);
  return gap_closed(same_windows(all.before[1], alone[0]), alone[0]);
}

PredictionOptions without_floors(PredictionOptions windows) {
  windows.floors = false;
  return windows;
}

HeldOutFlight as_flight(const HeldOutGap& all, const NoiseModel& noise) {
  return {all.record, all.stated, all.found, noise, all.before.back(), all.after.back()};
}

nlohmann::ordered_json as_json(const HeldOutGap& all, const SearchResult& search) {
  nlohmann::ordered_json out = as_json(all.gap), horizons = nlohmann::ordered_json::array();
  for (std::size_t h = 0; h < all.horizons.size(); ++h) {
    horizons.push_back({{"horizon", all.windows.horizons[h]}});
    horizons.back().update(as_json(all.horizons[h]));
  }
  out["horizons"] = horizons;
  out.update(motion_errors(all.record, compared(all, search)));
  out["channels"] = channel_errors(all, search.form.noise);
  return out;
}

}  // namespace ident
