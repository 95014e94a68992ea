// Table and traces of held-out prediction.
#include "ident/views/held_out_section.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/core/format_number.h"
#include "ident/views/prediction_traces.h"

namespace ident {

Section held_out_section(const Validation& validation, const FlightRecord& held_out, const Theta& theta,
                         const Eigen::VectorXd& before, const FlightFit& fit, Shown shown) {
  Section section{.title = "Held-out prediction",
                  .text =
                      "Fitted to the first 70 % of each log, judged on the rest: the state is "
                      "estimated from the past only, then predicted."};
  Table table{"Prediction error on held-out flight, in noise standard deviations",
              {"horizon s", "parameters before", "refined", "floor", "windows"},
              {}};
  for (const HorizonErrors& h : validation.horizons)
    table.rows.push_back({format_number(h.horizon), format_number(h.stated.error, 3),
                          format_number(h.refined.error, 3), format_number(h.refined.floor, 3),
                          std::to_string(h.refined.windows)});
  section.tables.push_back(std::move(table));
  if (shown != Shown::pictures) return section;
  std::vector<int> channels = channels_that_gain(validation.stated_longest, validation.refined_longest);
  channels.resize(std::min<std::size_t>(channels.size(), 2));
  section.plots = prediction_traces(held_out, {"parameters before", &theta, before},
                                    {"refined", &theta, fit.u}, fit.noise, channels, {0.5, 1.0});
  return section;
}

nlohmann::ordered_json held_out_json(const Validation& validation) {
  auto rows = nlohmann::ordered_json::array();
  for (const HorizonErrors& h : validation.horizons) {
    nlohmann::ordered_json one{
        {"horizon", h.horizon}, {"before", h.stated.error}, {"after", h.refined.error}};
    one.update(
        {{"after_ci95", h.refined.ci95}, {"noise_floor", h.refined.floor}, {"windows", h.refined.windows}});
    rows.push_back(one);
  }
  return rows;
}

std::string predicts_worse_text(const Validation& validation) {
  if (!validation.worse) return {};
  const HorizonErrors& shortest = validation.horizons.front();
  return fmt::format(
      "Held-out flight is predicted worse by the refined constants than by those stated: over {} s {} "
      "against {} standard deviations of noise, and no better over longer. The constants may stand in for an "
      "effect that the model lacks, so those far from their prior are not identifiable. Run `ident gap`.",
      format_number(shortest.horizon), format_number(shortest.refined.error, 3),
      format_number(shortest.stated.error, 3));
}

}  // namespace ident
