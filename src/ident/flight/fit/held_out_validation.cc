// Predicts held-out flight with both sets of constants and compares the errors.
#include "ident/flight/fit/held_out_validation.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/core/format_number.h"
#include "ident/flight/fit/prediction.h"
#include "ident/views/prediction_traces.h"

namespace ident {
namespace {

// Ratio of errors. A fit of a model without defect predicts as well as the stated constants or better. Where
// it is worse by this factor at the shortest horizon, and better at none, its constants may have taken the
// place of something missing.
constexpr double kWorse = 1.1;

}  // namespace

Validation validate_refined(const FlightRecord& held_out, const Theta& theta, const Eigen::VectorXd& before,
                            const FlightFit& fit, Shown shown) {
  Validation out{.section = {.title = "Held-out prediction",
                             .text = "Fitted to the first 70 % of each log, judged on the rest: the state is "
                                     "estimated from the past only, then predicted."},
                 .horizons = nlohmann::ordered_json::array(),
                 .worse = {}};
  Table table{"Prediction error on held-out flight, in noise standard deviations",
              {"horizon s", "parameters before", "refined", "floor", "windows"},
              {}};
  const PredictionOptions options{.steps = fit.serves}, errors{.floors = false, .steps = fit.serves};
  const auto stated = predict_windows(held_out, theta, before, fit.noise, errors);
  const auto refined = predict_windows(held_out, theta, fit.u, fit.noise, options);
  bool better = false;
  for (std::size_t h = 0; h < options.horizons.size(); ++h) {
    const double horizon = options.horizons[h];
    const PredictionSummary a = summarise(stated[h]), b = summarise(refined[h]);
    if (b.windows == 0) continue;
    table.rows.push_back({format_number(horizon), format_number(a.error, 3), format_number(b.error, 3),
                          format_number(b.floor, 3), std::to_string(b.windows)});
    nlohmann::ordered_json one{{"horizon", horizon}, {"before", a.error}, {"after", b.error}};
    one.update({{"after_ci95", b.ci95}, {"noise_floor", b.floor}, {"windows", b.windows}});
    out.horizons.push_back(one);
    better = better || b.error < (out.worse.empty() ? kWorse : 1.0) * a.error;
    if (out.worse.empty())
      out.worse = fmt::format(
          "flight that was not fitted is predicted worse by the refined constants than by those stated "
          "(over {} s {} against {} standard deviations of noise, and no better over longer): the model "
          "lacks something that moves this vehicle, and the constants may have taken its place (try ident "
          "gap)",
          format_number(horizon), format_number(b.error, 3), format_number(a.error, 3));
  }
  if (better) out.worse.clear();
  out.section.tables.push_back(std::move(table));
  if (shown != Shown::pictures) return out;
  std::vector<int> channels = channels_that_gain(stated.back(), refined.back());
  channels.resize(std::min<std::size_t>(channels.size(), 2));
  out.section.plots = prediction_traces(held_out, {"parameters before", &theta, before},
                                        {"refined", &theta, fit.u}, fit.noise, channels, {0.5, 1.0});
  return out;
}

}  // namespace ident
