// Predicts held-out flight with both sets of constants and compares the errors.
#include "ident/flight/fit/held_out_validation.h"

#include <utility>

namespace ident {
namespace {

// Ratio of errors. A fit of a model without defect predicts as well as the stated constants or better. Where
// it is worse by this factor at the shortest horizon, and better at none, its constants may have taken the
// place of something missing.
constexpr double kWorse = 1.1;

}  // namespace

Validation validate_refined(const FlightRecord& held_out, const Theta& theta, const Eigen::VectorXd& before,
                            const FlightFit& fit) {
  Validation out;
  const PredictionOptions options{.steps = fit.serves}, errors{.floors = false, .steps = fit.serves};
  auto stated = predict_windows(held_out, theta, before, fit.noise, errors);
  auto refined = predict_windows(held_out, theta, fit.u, fit.noise, options);
  bool better = false;
  for (std::size_t h = 0; h < options.horizons.size(); ++h) {
    const HorizonErrors one{options.horizons[h], summarise(stated[h]), summarise(refined[h])};
    if (one.refined.windows == 0) continue;
    better = better || one.refined.error < (out.horizons.empty() ? kWorse : 1.0) * one.stated.error;
    out.horizons.push_back(one);
  }
  out.worse = !out.horizons.empty() && !better;
  out.stated_longest = std::move(stated.back());
  out.refined_longest = std::move(refined.back());
  return out;
}

}  // namespace ident
