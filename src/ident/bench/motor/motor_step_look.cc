// Compares undriven stretches with driven rows, and arrival times with even times.
#include "ident/bench/motor/motor_step_look.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/bench/motor/motor_step_plateaus.h"
#include "ident/bench/motor/motor_step_undriven.h"

namespace ident {
namespace {

Warning settled_warning(std::size_t rows) {
  return {"settled_rows",
          fmt::format("{} rows long after the speed has settled are left out: they say nothing more of the "
                      "motor's answer",
                      rows)};
}

/// How many rows over how long were left out of one kind, in words.
std::string amount(const std::vector<StepRecord>& records, const std::vector<UndrivenStretch>& stretches,
                   UndrivenStretch::Kind kind) {
  std::size_t rows = 0;
  double time = 0.0;
  for (const UndrivenStretch& s : stretches) {
    if (s.kind != kind || s.begin == s.end) continue;
    rows += s.end - s.begin;
    time += records[s.record].t[s.end - 1] - records[s.record].t[s.begin];
  }
  return rows == 0 ? "" : fmt::format("{} rows ({:.2g} s)", rows, time);
}

Warning undriven_warning(const std::vector<StepRecord>& records,
                         const std::vector<UndrivenStretch>& stretches) {
  const std::string coasting = amount(records, stretches, UndrivenStretch::Kind::coasting);
  const std::string start = amount(records, stretches, UndrivenStretch::Kind::from_rest);
  std::string what;
  if (!coasting.empty()) what = coasting + " in which the motor is switched off and coasts or stands";
  if (!start.empty())
    what += (what.empty() ? "" : ", and ") + start + " from there until it first reaches its speed";
  return {"not_driven",
          what + ", are left out: the motor model, as the other rows give it, does not hold there"};
}

/// Leaves out stretches in which the motor is not driven, as far as the driven ones speak against them.
FirstLook look_at_driven(const std::vector<StepRecord>& records, const std::optional<MotorShape>& near,
                         std::vector<Warning>& warnings) {
  std::vector<UndrivenStretch> stretches = undriven_stretches(records);
  std::vector<StepRecord> driven = without(records, stretches);
  if (!has_edges(driven)) driven = records, stretches.clear();
  leave_out_settled_rows(driven);
  const MotorFit motor = guess_motor(driven, near);
  std::erase_if(stretches, [&](const UndrivenStretch& stretch) {
    return !contradicts(with_approach(records, stretch), motor);
  });
  if (!stretches.empty()) warnings.push_back(undriven_warning(records, stretches));
  FirstLook look{without(records, stretches), motor.shape, motor.fit.noise[0].sigma};
  if (const std::size_t rows = leave_out_settled_rows(look.records); rows > 0)
    warnings.push_back(settled_warning(rows));
  return look;
}

}  // namespace

FirstLook look_at_records(std::vector<StepRecord> records, std::vector<Warning>& warnings) {
  const bool bunched = std::ranges::any_of(records, has_bunched_times);
  if (!bunched && undriven_stretches(records).empty()) {
    if (const std::size_t rows = leave_out_settled_rows(records); rows > 0)
      warnings.push_back(settled_warning(rows));
    return {.records = std::move(records)};
  }
  std::vector<Warning> found, found_even;
  FirstLook look = look_at_driven(records, {}, found);
  if (bunched) {
    for (StepRecord& record : records)
      if (has_bunched_times(record)) record = with_even_times(record);
    FirstLook even = look_at_driven(records, look.near, found_even);
    if (even.sigma < look.sigma) {
      found = std::move(found_even);
      found.push_back(
          {"bunched_times",
           fmt::format("rows come in bursts, so their times say when they were passed on; times of equal "
                       "distance were taken instead, which brings the noise from {:.3g} to {:.3g} rad/s",
                       look.sigma, even.sigma)});
      look = std::move(even);
    }
  }
  warnings.insert(warnings.end(), found.begin(), found.end());
  return look;
}

}  // namespace ident
