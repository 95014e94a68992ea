// Constants as they were stated, over which those of the chosen rung are written.
#include "ident/flight/refine_along_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ident/core/error.h"
#include "ident/effects/all_parameters.h"
#include "ident/flight/checks/log_self_test.h"
#include "ident/flight/conditioning/battery_voltage.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/fit/hover_priors.h"
#include "ident/views/chosen_rung.h"
#include "ident/views/data_health.h"

namespace ident {

std::optional<LadderResult> ladder_of(const FlightRecord& record, const RefineOptions& options) {
  if (!options.validate || record.duration <= kLeastJudged) return {};
  return climb_ladder(record);
}

bool ends_along_motion(const LadderResult& ladder, const FlightEntry& entry, const RefineOptions& options) {
  return ladder.misses_turning && options.free.empty() && !is_hover(entry.tested);
}

std::optional<Result> refined_along_motion(const Vehicle& vehicle, std::span<const FlightLog> logs,
                                           const RefineOptions& options) {
  Result begun;
  begun.command = "flightlog";
  try {
    const FlightEntry entry = enter_flight(vehicle, logs, begun);
    const std::optional<LadderResult> ladder = ladder_of(entry.record, options);
    if (!ladder || !ends_along_motion(*ladder, entry, options)) return {};
    return refined_along_motion(std::move(begun), vehicle, logs, entry, *ladder, options.shown);
  } catch (const DataError&) {
    return {};
  }
}

Result refined_along_motion(Result result, const Vehicle& vehicle, std::span<const FlightLog> logs,
                            const FlightEntry& entry, const LadderResult& ladder, Shown shown) {
  const FlightRecord& record = entry.record;
  for (const FreeConstant& c : free_constants(vehicle, entry.p)) {
    Parameter p;
    p.name = c.name, p.unit = parameter_unit(c.name), p.source = "flightlog";
    p.value = c.start, p.std = c.prior_std.value_or(std::abs(c.unit()));
    if (c.prior_std) p.prior_value = c.prior_value, p.prior_std = *c.prior_std;
    result.parameters.push_back(std::move(p));
  }
  settle_for_chosen(result, ladder, vehicle);
  const auto has_battery = [](const Parameter& p) { return p.name.starts_with("battery_sag"); };
  if (std::ranges::none_of(result.parameters, has_battery))
    if (const auto battery = battery_not_modelled(vehicle, logs)) result.warnings.push_back(*battery);
  result.fit = {{"seconds", record.duration}, {"by", "measured_motion"}};
  if (shown != Shown::numbers)
    result.sections.push_back(data_health(record, logs, initial_noise(record), entry.vibration));
  const auto determined =
      std::ranges::count_if(result.parameters, [](const Parameter& p) { return p.identifiable; });
  result.verdict = fmt::format(
      "{} of {} parameters are determined by {:.0f} s of flight, along measured motion: what was "
      "logged of the rotors does not explain how the vehicle turned.",
      determined, result.parameters.size(), record.duration);
  if (const std::string wrong = disqualified(entry.tested); !wrong.empty()) distrust(result, wrong);
  return result;
}

}  // namespace ident
