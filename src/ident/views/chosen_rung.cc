// Puts values, intervals and notes of one rung into a result.
#include "ident/views/chosen_rung.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/effects/all_parameters.h"
#include "ident/effects/cause_traits.h"
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
  const bool stands_for_all = stands_for_lasting_moment(c);
  if (stands_for_all) p.identifiable = false;
  // Weak by itself, and yet of one model with the rest: it predicts only together with that.
  p.joint = !p.identifiable;
  if (stands_for_all)
    p.note = "stands for whatever makes a lasting moment, a weak rotor or a bent arm too";
  else if (!p.identifiable)
    p.note = "these logs say little of it by itself; it belongs to the model that was taken";
  return p;
}

// Why the full refinement was not taken.
std::string refusal_of_full(const LadderResult& ladder) {
  if (ladder.rungs.back().rung == Rung::full) return refusal_in_words(ladder.rungs.back());
  return "was not tried, for what was logged of the rotors does not explain how the vehicle turned";
}

// As it was before the flight, whatever the refused fit made of it.
void as_before(Parameter& p, double value, const Vehicle& vehicle, const std::string& why) {
  p.value = value, p.std = vehicle.has(p.name) ? vehicle.parameters.at(p.name).std.value_or(kNaN) : kNaN;
  p.ci95 = {p.value - 1.96 * p.std, p.value + 1.96 * p.std};
  p.naive_std.reset(), p.pull.reset();
  p.from_flight = 0.0, p.note = why;
  p.identifiable = p.joint = false;
}

}  // namespace

bool stands_for_lasting_moment(const RungConstant& c) {
  return !c.prior_std && traits_of(c.name.substr(0, c.name.find('.'))).moves_mass;
}

Parameter parameter_of(const RungConstant& constant) { return estimated(constant, {}); }

void settle_for_chosen(Result& result, const LadderResult& ladder, const Vehicle& vehicle) {
  result.sections.push_back(ladder_section(ladder));
  result.extra["ladder"] = as_json(ladder);
  const RungResult& chosen = ladder.rungs[ladder.chosen];
  if (chosen.rung == Rung::full) return;
  const std::string full = refusal_of_full(ladder);
  const std::string why =
      fmt::format("as stated: the full refinement {}, and this is not of the model that was taken ({})", full,
                  rung_name(chosen.rung));
  const std::vector<double>& stated = ladder.rungs.front().p;
  std::vector<Parameter> settled;
  for (Parameter& p : result.parameters) {
    const auto found = std::ranges::find(chosen.constants, p.name, &RungConstant::name);
    const double before = stated[static_cast<std::size_t>(find_parameter(p.name)->index)];
    if (found != chosen.constants.end())
      settled.push_back(estimated(*found, p));
    else if (vehicle.has(p.name) || before != default_value(p.name))  // else the refused fit had added it
      as_before(p, before, vehicle, why), settled.push_back(p);
  }
  for (const RungConstant& c : chosen.constants)
    if (!result.find(c.name)) settled.push_back(parameter_of(c));
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
