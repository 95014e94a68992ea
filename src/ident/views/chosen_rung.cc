// Puts values, intervals and notes of one rung into a result.
#include "ident/views/chosen_rung.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/effects/all_parameters.h"
#include "ident/views/ladder_section.h"

namespace ident {
namespace {

constexpr double kUseful = 0.5;  // of the deviation before: as for the full refinement
constexpr double kShare = 0.1;   // of the value, where nothing was stated

Parameter estimated(const RungConstant& c, Parameter p) {
  p.name = c.name, p.value = c.value, p.std = c.std;
  p.ci95 = {c.value - 1.96 * c.std, c.value + 1.96 * c.std};
  p.unit = parameter_unit(c.name), p.source = "flightlog";
  p.naive_std.reset(), p.pull.reset(), p.note.clear();
  p.joint = p.known_together = false;
  p.from_flight = 1.0;
  p.identifiable = c.std < kShare * std::abs(c.value);
  if (c.prior_std) {
    p.prior_value = c.prior_value, p.prior_std = *c.prior_std;
    const double ratio = std::min(c.std / *c.prior_std, 1.0);
    p.from_flight = 1 - ratio * ratio;
    p.identifiable = ratio < kUseful;
    if (*p.from_flight > 0.05)
      p.pull = (c.value - c.prior_value) / (*c.prior_std * std::sqrt(*p.from_flight));
  }
  // Weak by itself, and yet of one model with the rest: it predicts only together with that.
  p.joint = !p.identifiable;
  if (!p.identifiable)
    p.note = "these logs say little of it by itself; it belongs to the model that was taken";
  return p;
}

// Why the full refinement was not taken.
std::string refusal_of_full(const LadderResult& ladder) {
  if (ladder.rungs.back().rung == Rung::full) return refusal_in_words(ladder.rungs.back());
  return "was not tried, for rates are predicted worse by what was logged of the rotors than by no model";
}

void as_stated(Parameter& p, const Vehicle& vehicle, const std::string& why) {
  if (vehicle.has(p.name)) {
    const Known& known = vehicle.parameters.at(p.name);
    p.value = known.value, p.std = known.std.value_or(kNaN);
  }
  p.ci95 = {p.value - 1.96 * p.std, p.value + 1.96 * p.std};
  p.naive_std.reset(), p.pull.reset();
  p.from_flight = 0.0, p.note = why;
  p.identifiable = p.joint = false;
}

}  // namespace

void settle_for_chosen(Result& result, const LadderResult& ladder, const Vehicle& vehicle) {
  result.sections.push_back(ladder_section(ladder));
  result.extra["ladder"] = as_json(ladder);
  const RungResult& chosen = ladder.rungs[ladder.chosen];
  if (chosen.rung == Rung::full) return;
  const std::string full = refusal_of_full(ladder);
  const std::string why =
      fmt::format("as stated: the full refinement {}, and this is not of the model that was taken ({})", full,
                  rung_name(chosen.rung));
  std::vector<Parameter> settled;
  for (Parameter& p : result.parameters) {
    const auto found = std::ranges::find(chosen.constants, p.name, &RungConstant::name);
    if (found != chosen.constants.end())
      settled.push_back(estimated(*found, p));
    else
      as_stated(p, vehicle, why), settled.push_back(p);
  }
  for (const RungConstant& c : chosen.constants)
    if (!result.find(c.name)) settled.push_back(estimated(c, {}));
  result.parameters = std::move(settled);
  result.correlation = chosen.correlation;
  // What was said of the values that are given no more.
  std::erase_if(result.warnings, [](const Warning& w) {
    return w.code == "predicts_worse" || w.code == "not_identifiable" || w.code == "prior_disagrees" ||
           w.code == "correlated" || w.code == "triangle_inequality";
  });
  result.warn("ladder",
              fmt::format("the full refinement {}: the model that was taken is the one {}, and what is "
                          "not of it keeps its stated value; try ident gap for what the full one lacks",
                          full, rung_name(chosen.rung)));
}

}  // namespace ident
