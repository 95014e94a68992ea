// Held-out velocity by both models, attitude and rates as measured.
#include "ident/gap/stands_against.h"

#include <algorithm>
#include <cmath>

#include "ident/flight/ladder/held_out_errors.h"
#include "ident/flight/ladder/paired_comparison.h"
#include "ident/flight/record/excerpts.h"
#include "ident/gap/verdict/decision.h"

namespace ident {
namespace {

constexpr double kByChance = 0.05 / kLadderHorizons.size();  // over all horizons

// Whether errors are worse than those of `better`, at any horizon, beyond chance, and by a material part of
// what that closes of the errors `without` causes.
bool worse(const std::vector<WindowErrors>& errors, const std::vector<WindowErrors>& better,
           const std::vector<WindowErrors>& without) {
  for (std::size_t h = 0; h < kLadderHorizons.size(); ++h) {
    const auto square = [&](const std::vector<WindowErrors>& of) {
      return std::pow(error_of(of, Metric::velocity, h), 2);
    };
    if (square(errors) - square(better) > kMaterial * std::max(square(without) - square(better), 0.0) &&
        worse_beyond_chance(errors, better, Metric::velocity, h, kByChance))
      return true;
  }
  return false;
}

}  // namespace

bool is_unsure(const Judged& verdict) { return verdict.status == "ambiguous" || verdict.status == "unknown"; }

bool predicts_worse(const FlightRecord& record, const std::vector<double>& p,
                    const std::vector<double>& than) {
  if (!std::ranges::all_of(p, [](double x) { return std::isfinite(x); })) return true;
  const FlightRecord rest = held_out_of(record, kTrainingShare);
  const MeasuredMotion motion = measured_motion(rest);
  if (!motion.forces || motion.arcs.empty()) return false;
  const std::vector<WindowErrors> of_p = held_out_errors(motion, p), of_other = held_out_errors(motion, than);
  for (std::size_t h = 0; h < kLadderHorizons.size(); ++h)
    if (worse_beyond_chance(of_p, of_other, Metric::velocity, h, kByChance)) return true;
  return false;
}

bool stands_against(const WindowDiagnosis& windows, const FlightRecord& record,
                    const std::vector<double>& whole, const Judged& verdict) {
  const FlightRecord rest = held_out_of(record, kTrainingShare);
  const MeasuredMotion motion = measured_motion(rest);
  if (!motion.forces || motion.arcs.empty()) return false;
  if (!std::ranges::all_of(whole, [](double x) { return std::isfinite(x); })) return true;
  const auto errors = [&](const std::vector<double>& p) { return held_out_errors(motion, p); };
  const std::vector<WindowErrors> of_whole = errors(whole), of_windows = errors(windows.trained),
                                  without = errors(windows.without_causes);
  const std::vector<std::string>& others = verdict.effects;
  if (std::ranges::all_of(windows.of_forces, [&](const std::string& name) {
        return std::ranges::find(others, name) != others.end();
      }))
    return false;
  if (worse(of_whole, of_windows, without)) return true;
  return is_unsure(verdict) && !worse(of_windows, of_whole, without);
}

bool needs_no_windows(const LadderResult& ladder, const FlightRecord& record,
                      const std::vector<double>& whole, const Judged& verdict) {
  const MeasuredMotion motion = measured_motion(held_out_of(record, kTrainingShare));
  return !is_unsure(verdict) && motion.forces && !motion.arcs.empty() &&
         !predicts_worse(record, whole, ladder.rungs[ladder.chosen].trained);
}

}  // namespace ident
