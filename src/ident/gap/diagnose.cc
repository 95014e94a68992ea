// Which way a flight is diagnosed: by its balance, along measured motion, by models of the whole flight.
#include "ident/gap/diagnose.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/flight/checks/log_self_test.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/fit/hover_priors.h"
#include "ident/flight/ladder/ladder.h"
#include "ident/flight/prepare.h"
#include "ident/flight/refine_trim.h"
#include "ident/gap/diagnose_trim.h"
#include "ident/gap/diagnose_whole.h"
#include "ident/gap/diagnose_windows.h"
#include "ident/gap/found_by_ladder.h"
#include "ident/gap/stands_against.h"
#include "ident/gap/views/verdict_json.h"
#include "ident/result/doubted_intervals.h"
#include "ident/views/data_health.h"

namespace ident {
namespace {

void require_known(const std::vector<std::string>& causes) {
  std::vector<std::string> known;
  for (const EffectEntry& effect : catalogue()) known.emplace_back(effect.info.name);
  for (const ParameterInfo& parameter : all_parameters())
    if (parameter.name.find('.') == std::string::npos) known.push_back("parameter:" + parameter.name);
  for (const std::string& cause : causes)
    if (std::ranges::find(known, cause) == known.end())
      throw UsageError(fmt::format("no cause '{}' to leave out{}", cause, did_you_mean(cause, known)));
}

void warn_of_measured_motion(Result& result, bool misses_turning, const std::string& why) {
  const std::string reason =
      misses_turning
          ? "what was logged of the rotors does not explain how the vehicle turned, so no model of the whole "
            "flight is fitted"
      : why.empty()
          ? "no model of the whole flight predicts velocity as well as forces along the measured motion do"
          : "no model of the whole flight can be fitted (" + why + ")";
  result.warn("measured_motion",
              reason + ": causes are looked for in forces and moments, attitude and rates as measured");
}

Diagnosis diagnosed_gap(const Vehicle& stated, std::span<const FlightLog> logs, const GapOptions& options) {
  const Vehicle vehicle = with_doubted_effects(stated);
  Diagnosis out;
  Result& result = out.result;
  result.schema = "ident.gap/1";
  result.command = "gap";
  require_known(options.exclude);
  auto [p, record, tested, vibration] = enter_flight(vehicle, logs, result);
  if (only_trim(record.signals)) {
    diagnose_trim(out, record, p, options.exclude);
    if (const std::string wrong = disqualified(tested); !wrong.empty()) {
      out.verdict = {.status = "unknown", .sentence = wrong};
      result.extra["verdict"] = to_json(out.verdict);
      result.verdict = wrong;
      distrust(result, wrong);
    }
    result.sections.push_back(data_health(record, logs, initial_noise(record), vibration));
    return out;
  }
  require_turning(record.signals);
  const FlightEntry entry{std::move(p), std::move(record), std::move(tested), std::move(vibration)};
  // Logs that cannot be trusted tell nothing along measured motion either, and hover tells no cause.
  const bool barred = !disqualified(entry.tested).empty() || is_hover(entry.tested);
  const std::optional<LadderResult> ladder = barred ? std::nullopt : climb_ladder(entry.record);
  const bool misses_turning = ladder && ladder->misses_turning;
  const std::optional<FoundByLadder> found = ladder ? found_by_ladder(*ladder) : std::nullopt;
  const auto along_motion = [&] { return diagnose_windows(vehicle, logs, options, entry, result, found); };
  std::optional<WindowDiagnosis> windows;
  if (misses_turning) windows = along_motion();
  std::optional<WholeDiagnosis> whole;
  std::string why;
  if (!windows || is_unsure(windows->verdict)) {
    try {
      whole = diagnose_whole(vehicle, logs, options, entry, result);
    } catch (const DataError& error) {
      why = error.what();
    }
    const bool settled = barred || (whole && ladder &&
                                    needs_no_windows(*ladder, entry.record, whole->trained, whole->verdict));
    if (!settled && !windows) windows = along_motion();
  }
  if (!windows || (whole && !stands_against(*windows, entry.record, whole->trained, whole->verdict))) {
    if (!whole) throw DataError(why);
    return *std::move(whole);
  }
  warn_of_measured_motion(windows->result, misses_turning && !whole, why);
  return *std::move(windows);
}

}  // namespace

Diagnosis diagnose_gap(const Vehicle& stated, std::span<const FlightLog> logs, const GapOptions& options) {
  Diagnosis out = diagnosed_gap(stated, logs, options);
  widen_doubted(out.result.parameters);
  return out;
}

}  // namespace ident
