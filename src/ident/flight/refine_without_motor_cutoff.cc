// Stretches with a motor off, and whether they say what the others do.
#include "ident/flight/refine_without_motor_cutoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/flight/checks/log_self_test.h"
#include "ident/flight/make_record.h"
#include "ident/flight/record/arcs.h"
#include "ident/flight/record/flight_record.h"
#include "ident/flight/refine_along_motion.h"
#include "ident/result/doubted_intervals.h"

namespace ident {
namespace {

constexpr double kOff = 0.0099;      ///< s: so long without drive, a speed is another than the commanded one
constexpr double kEnoughLeft = 0.3;  ///< of the flight of a log
constexpr double kContradicts = 3.0;
constexpr double kTold = 0.75;  // of what is known beforehand, at most, is left of what flight tells
// Of the deviation by driven rows: nothing is said of less, for deviations are known no better themselves.
constexpr double kLeast = 0.5;

// Stretches of one motor's commands of 0, each up to the first row with another.
void add_stretches(const FlightLog& log, const std::vector<double>& delta, double dead_time,
                   std::vector<std::array<double, 2>>& all) {
  std::size_t begin = log.rows();  // of one that is not over
  const auto close = [&](double end) {
    if (begin < log.rows() && end - log.t[begin] >= kOff) all.push_back({log.t[begin], end + dead_time});
    begin = log.rows();
  };
  for (std::size_t i = 0; i < log.rows(); ++i) {
    if (std::isnan(delta[i])) continue;
    if (delta[i] <= 0)
      begin = std::min(begin, i);
    else
      close(log.t[i]);
  }
  if (log.rows() > 0) close(std::nextafter(log.t.back(), HUGE_VAL));
}

double seconds_flown(const FlightLog& log) {
  std::vector<Warning> said;
  double sum = 0;
  for (const auto& [begin, end] : whole_pieces(log, 0.0, RecordOptions{}.longest_gap, said))
    sum += log.t[end - 1] - log.t[begin];
  return sum;
}

// None where these logs cannot be flown, unless they have to be.
std::optional<Result> refined(const Vehicle& vehicle, std::span<const FlightLog> logs,
                              const RefineOptions& options, bool has_to) {
  try {
    return refine_as_logged(vehicle, logs, options);
  } catch (const DataError&) {
    if (has_to) throw;
    return {};
  }
}

// A constant that flight tells, and of which a fit of all rows says something else than one of those with all
// motors driven, by more than three standard deviations of the difference [Hausman 1978]; empty: none.
std::string contradicted_by_driven(const Result& all, const Result& driven) {
  const bool like_motors = all.has_warning("first_order_motors") == driven.has_warning("first_order_motors");
  std::string name;
  std::pair most{false, kContradicts};  // one that counts as known says most
  for (const Parameter& p : driven.parameters) {
    const Parameter* with = all.find(p.name);
    if (!with || !(p.std > 0) || (p.prior_std && p.std > kTold * *p.prior_std)) continue;
    if (!like_motors && (p.name == "omega_m" || p.name == "zeta_m")) continue;
    // Fewer rows tell less, unless the others bend the fit: then it is not known how far these may be apart.
    const double apart =
        std::sqrt(std::max(std::abs(p.std * p.std - with->std * with->std), std::pow(kLeast * p.std, 2)));
    const double by = std::abs(with->value - p.value) / apart;
    if (by > kContradicts && std::pair{p.identifiable, by} > most) most = {p.identifiable, by}, name = p.name;
  }
  return name;
}

void warn_not_driven(Result& result, const std::string& why) {
  result.warn("not_driven", "Rows around commands of 0 are not used, because a motor that is off coasts: " +
                                why + ". Keep every command above 0 in flight.");
}

}  // namespace

std::optional<std::vector<FlightLog>> without_undriven(const Vehicle& vehicle,
                                                       std::span<const FlightLog> logs) {
  const auto stated = vehicle.parameters.find("dead_time");
  const double dead_time = stated == vehicle.parameters.end() ? 0.0 : std::max(stated->second.value, 0.0);
  std::vector<FlightLog> out;
  bool any = false;
  for (const FlightLog& log : logs) {
    FlightLog& driven = out.emplace_back(log);
    for (const std::vector<double>& delta : log.delta) add_stretches(log, delta, dead_time, driven.left_out);
    if (driven.left_out.size() == log.left_out.size()) continue;
    const double all = seconds_flown(log), left = seconds_flown(driven);
    if (left < kEnoughLeft * all) return std::vector<FlightLog>{};
    any |= left < all;
  }
  if (!any) return {};
  return out;
}

namespace {

Result refined_of_driven(const Vehicle& vehicle, std::span<const FlightLog> logs,
                         const RefineOptions& options) {
  const auto driven = without_undriven(vehicle, logs);
  if (!driven) return refine_as_logged(vehicle, logs, options);
  // Nothing is estimated of motors along measured motion.
  if (std::optional<Result> out = refined_along_motion(vehicle, driven->empty() ? logs : *driven, options)) {
    if (!driven->empty()) warn_not_driven(*out, "forces along measured motion do without them");
    return *std::move(out);
  }
  // Both fits are of the same model: before validation, which may take a simpler one.
  RefineOptions only_fit = options;
  only_fit.validate = false;
  const auto whole = [&](const Result& fit, std::span<const FlightLog> used) {
    return options.validate ? refine_as_logged(vehicle, used, options) : fit;
  };
  std::optional<Result> all = refined(vehicle, logs, only_fit, driven->empty());
  // Measured speeds may be what drives the vehicle.
  if (all && !all->find("omega_m")) return whole(*all, logs);
  std::optional<Result> result;
  if (!driven->empty()) result = refined(vehicle, *driven, only_fit, !all);
  const auto wrong = [](const Result& r) { return !disqualified(r.warnings).empty(); };
  if (all && result && wrong(*all) && wrong(*result)) return whole(*all, logs);
  // Pieces may be too short to tell how sensors are mounted and rotors turn.
  if (!result || (all && wrong(*result))) {
    Result out = whole(*all, logs);
    out.warn("motors_off",
             "Motors are off (commands of 0) so often that the other rows tell little. These rows are used "
             "as if motors followed their commands. Motors that coast do not, which biases the motor "
             "constants. Keep every command above 0 in flight.");
    return out;
  }
  std::string with = "nothing flies with them";
  if (all) {
    const std::string name = contradicted_by_driven(*all, *result);
    if (name.empty()) return whole(*all, logs);
    with = fmt::format("with them {} would be {}", name, format_number(all->find(name)->value, 3));
  }
  Result out = whole(*result, *driven);
  warn_not_driven(out, with);
  return out;
}

}  // namespace

Result refine_flight(const Vehicle& vehicle, std::span<const FlightLog> logs, const RefineOptions& options) {
  Result result = refined_of_driven(vehicle, logs, options);
  widen_doubted(result.parameters);
  return result;
}

}  // namespace ident
