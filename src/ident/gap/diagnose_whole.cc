// By models of the whole flight: search, held-out flight, shares, verdict; closer, or with motors left open,
// where that may tell more.
#include "ident/gap/diagnose_whole.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/effects/cause_traits.h"
#include "ident/flight/checks/command_rate.h"
#include "ident/flight/checks/implausible_estimates.h"
#include "ident/flight/checks/intersample_commands.h"
#include "ident/flight/checks/log_self_test.h"
#include "ident/flight/checks/logs_consistent.h"
#include "ident/flight/checks/rotor_speed_jitter.h"
#include "ident/flight/conditioning/battery_voltage.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/fit/hover_priors.h"
#include "ident/flight/fit/input_sensitivity.h"
#include "ident/flight/fit/physical_inertia.h"
#include "ident/flight/fit/prediction.h"
#include "ident/flight/prepare.h"
#include "ident/gap/evidence/causes_tried.h"
#include "ident/gap/evidence/evidence.h"
#include "ident/gap/evidence/held_out_gap.h"
#include "ident/gap/evidence/shares.h"
#include "ident/gap/search/model_search.h"
#include "ident/gap/stands_against.h"
#include "ident/gap/statistics/generic_rival.h"
#include "ident/gap/statistics/residual_wrench.h"
#include "ident/gap/verdict/input_smoothing.h"
#include "ident/gap/verdict/open_commands.h"
#include "ident/gap/verdict/out_of_balance.h"
#include "ident/gap/verdict/seldom_input.h"
#include "ident/gap/verdict/unnamed_values.h"
#include "ident/gap/verdict/verdict.h"
#include "ident/gap/verdict/verdict_sentence.h"
#include "ident/gap/views/gap_sections.h"
#include "ident/gap/views/gap_where.h"
#include "ident/gap/views/search_details.h"
#include "ident/gap/views/signature_plot.h"
#include "ident/gap/views/verdict_json.h"
#include "ident/result/json_number.h"
#include "ident/views/data_health.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

// Hover tells that something is missing, not what.
Judged in_hover(Judged verdict) {
  if (verdict.status == "none") return verdict;
  if (!verdict.effects.empty()) {
    verdict.sentence = fmt::format("The nearest is {}.", fmt::join(verdict.effects, " with "));
    verdict = unnamed(std::move(verdict));
  }
  verdict.status = "unknown";
  verdict.sentence +=
      " These logs hold little more than hover, and that tells no cause: none was tried in full. Fly "
      "doublets or a multisine about every axis.";
  return verdict;
}

// Whether what is left lies at the noise, so that only its pattern speaks, and gusts were held for longer
// than they last: where a controller answers them within that, its answer is a pattern too.
bool gusts_may_be_all(const FlightRecord& record, const SearchResult& search, const GapClosed& gap) {
  constexpr double kAtTheNoise = 2.0, kShorter = 0.8;
  return gap.after < kAtTheNoise * gap.floor &&
         chunk_for(record, search.form.noise) < kShorter * search.best.fit.chunk_seconds;
}

// How a flight is looked at: first, or closer, with gusts in steps as short as a refinement has them. By
// commands that held from row to row, or that did not.
enum class Look { first, closer };
enum class Commands { held, open };

// A diagnosis, and where one that is `unknown` may be for its commands, whether these held.
struct Looked : WholeDiagnosis {
  HeldCommands commands;
  bool closer_may_tell = false;
};

// Where the battery matters, it matters at which voltage km holds.
void warn_of_battery(Result& result, const Judged& verdict, const Vehicle& vehicle,
                     std::span<const FlightLog> logs) {
  const auto tells = [](const std::vector<std::string>& names) {
    return std::ranges::any_of(names, [](const std::string& n) { return traits_of(n).of_battery; });
  };
  const double highest = highest_voltage(logs);
  if (vehicle.battery_voltage || !(highest > 0) || !(tells(verdict.effects) || tells(verdict.confused_with)))
    return;
  result.warn("battery_voltage",
              fmt::format("km counts as that at the highest voltage of these logs, {} V: where a bench found "
                          "it at another, state that as battery_voltage in the vehicle file",
                          format_number(highest, 4)));
}

// What a search leaves to be judged; `before` and `after` are of the base model and of the one found.
struct Findings {
  ResidualWrench before, after;
  Rival rival;
  HeldOutGap held_out;
  GapShares shares;
  std::vector<SpectralLine> lines;
  std::vector<Burst> jumps;
  std::vector<Unsteady> unsteady;
};

Findings findings_of(const FlightRecord& record, const SearchResult& search) {
  const auto wrench = [&](const FittedModel& model) {
    return residual_wrench(record, *model.theta, model.fit, search.form.noise);
  };
  ResidualWrench before = wrench(search.base);
  ResidualWrench after = search.best.adopted.empty() ? before : wrench(search.best);
  HeldOutGap held_out = held_out_gap(record, search);
  GapShares shares = gap_shares(held_out, search);
  std::vector<Unsteady> unsteadiness = unsteady(after);
  return {std::move(before),
          std::move(after),
          generic_rival(record, *search.best.theta, search.best.fit, search.form.noise),
          std::move(held_out),
          std::move(shares),
          spectral_lines(record, search.best.fit),
          bursts(record, search.best.fit),
          std::move(unsteadiness)};
}

// The constants of the model found. What hover held is known no better than before.
void state_constants(Result& result, const SearchResult& search, const Vehicle& vehicle,
                     const std::vector<double>& p, bool hover) {
  FlightFit body = search.best.fit;
  body.smoother.reset(), body.u = nearest_body(*search.best.theta, body);
  result.parameters = flight_parameters(*search.best.theta, body, "gap");
  warn_of_inertia(result, *search.best.theta, search.best.fit);
  if (hover) {
    const std::vector<FreeConstant> known = free_constants(vehicle, p);
    std::vector<FreeConstant> held = known;
    as_before_flight(result.parameters, known, hold_for_hover(held));
  }
  result.prior_correlation =
      vehicle.correlation.part([&](const std::string& name) { return result.find(name) != nullptr; });
}

// Where speeds are the input: causes that hang on how these were smoothed, or are smaller than their errors.
Judged doubted_for_input(Judged verdict, const FlightRecord& record, const SearchResult& search,
                         const HeldOutGap& held_out, const std::vector<std::string>& loose) {
  const std::vector<std::string> small = below_their_limit(search, least_size(record));
  const double without = small.empty() ? kNaN
                                       : refitted_error(search.base, record, held_out.record,
                                                        search.form.noise, without_floors(held_out.windows));
  return with_noisy_input(std::move(verdict), loose, small, held_out.judged, without);
}

// A diagnosis of a flight that was entered, with what `begun` says of it.
Looked diagnosed(const Vehicle& vehicle, std::span<const FlightLog> logs, const GapOptions& options,
                 FlightEntry entry, Result begun, Look look, Commands commands) {
  auto [p, record, tested, vibration] = std::move(entry);
  Looked out;
  out.result = std::move(begun);
  Result& result = out.result;
  const bool hover = is_hover(tested);
  const SearchOptions search_options{options.exclude, hover ? 0 : options.most_causes, hover,
                                     look == Look::closer, options.progress};
  SearchResult search = search_causes(record, vehicle, p, search_options);
  const FeltJitter jitter = felt_jitter(record, *search.best.theta, search.best.fit);
  const Eigen::VectorXd moved = moved_by_rougher_speeds(record, *search.best.theta, search.best.fit);
  const std::vector<std::string> loose = depend_on_smoothing(search.best, moved);
  search.best.fit.covariance += moved * moved.transpose();
  if (commands == Commands::open) {
    const Eigen::VectorXd late =
        moved_by_time(input_interval(record, logs) / 2, *search.best.theta, search.best.fit);
    search.best.fit.covariance += late * late.transpose();
  }
  // What a cause explains, logs need not agree on without it: a battery at another charge.
  if (!logs_agree(record, logs, *search.base.theta, search.base.fit).empty())
    for (const Warning& w : logs_agree(record, logs, *search.best.theta, search.best.fit))
      result.warnings.push_back(w), tested.push_back(w);
  if (options.progress) options.progress(0.9, "held-out flight");

  const Findings seen = findings_of(record, search);
  out.trained = search.best.theta->p(seen.held_out.found);
  const GapClosed& gap = seen.held_out.judged;
  state_constants(result, search, vehicle, p, hover);
  if (commands == Commands::open) doubt_open_motors(result.parameters);
  const Seen rests_on{search,     gap,        seen.shares,   seen.rival,
                      seen.lines, seen.jumps, seen.unsteady, result.parameters};
  Judged verdict = judge(rests_on);
  if (commands == Commands::open)
    verdict = with_open_commands(std::move(verdict), result.parameters, input_interval(record, logs),
                                 [&](const Judged& left) { return sentence_of(left, rests_on); });
  doubt_negative_dead_time(result);
  warn_of_disagreement(result, "something that no cause found explains takes its place");
  const std::string wrong = disqualified(tested);
  if (hover) verdict = in_hover(std::move(verdict));
  if (has_noisy_input(record))
    verdict = doubted_for_input(std::move(verdict), record, search, seen.held_out, loose);
  const std::optional<double> hidden = hides_motion(record, logs);
  const bool doubtful = verdict.status == "unknown" && wrong.empty() && !hover && !hidden;
  out.closer_may_tell = doubtful && look == Look::first && gusts_may_be_all(record, search, gap);
  verdict = with_vibration(std::move(verdict), vibration);
  if (jitter.matters()) {
    result.warnings.push_back(
        jitter.warning("no cause of the catalogue does this, and it hides what is small"));
    verdict = with_jitter(std::move(verdict));
  }
  if (hidden) verdict = with_seldom_commands(std::move(verdict), *hidden);
  // Where commands come as often as rates, only what no cause explains speaks against them.
  const bool by_commands = wrong.empty() && !hover && !hidden &&
                           std::ranges::any_of(logs, commands_are_rarer_than_rates) &&
                           may_be_commands(verdict.effects, result.parameters);
  if ((doubtful || by_commands) && commands == Commands::held)
    out.commands = commands_held(record, logs, *search.best.theta, search.best.fit);
  if (!wrong.empty()) verdict = {.status = "unknown", .sentence = wrong};
  warn_of_battery(result, verdict, vehicle, logs);

  result.verdict = verdict.sentence;
  result.extra["verdict"] = to_json(verdict, seen.after);
  result.extra["where"] = where_json(seen.before);
  Json tried = causes_tried(
      search, [&](const Candidate& cause) { return closed_alone(seen.held_out, search, cause); });
  enter_causes(tried, verdict);
  doubt_unnamed(result.parameters, search.best.adopted, verdict.effects);
  result.extra["candidates"] = std::move(tried);
  result.extra["not_tried"] = causes_not_tried(search, vehicle, options.exclude);
  result.extra["gap"] = as_json(seen.held_out, search);
  result.extra["gap"]["without_causes"] = number_or_null(seen.shares.without_causes);
  result.extra.update(search_details({search, seen.before, seen.rival, seen.lines, vibration, seen.jumps}));
  if (!wrong.empty()) distrust(result, wrong);
  const GapEvidence evidence =
      evidence_of(record, search, as_flight(seen.held_out, search.form.noise), options.shown);
  result.extra["signatures"] = to_json(evidence.signatures);
  result.sections = gap_sections(result.extra, seen.before, seen.after, evidence);
  result.sections.push_back(data_health(record, logs, search.best.fit.noise, vibration));
  const bool none = verdict.status == "none";  // and nothing of a cause is written
  out.adopted = hover ? vehicle : adopted_vehicle(vehicle, none ? search.base : search.best);
  out.verdict = std::move(verdict), out.gap = seen.held_out.gap;
  return out;
}

// A closer look counts where it predicts held-out velocity no worse than the first.
Looked looked_at(const Vehicle& vehicle, std::span<const FlightLog> logs, const GapOptions& options,
                 const FlightEntry& entry, const Result& begun, Commands commands) {
  Looked first = diagnosed(vehicle, logs, options, entry, begun, Look::first, commands);
  if (!first.closer_may_tell) return first;
  try {
    Looked closer = diagnosed(vehicle, logs, options, entry, begun, Look::closer, commands);
    if (std::isfinite(closer.gap.after) && !predicts_worse(entry.record, closer.trained, first.trained))
      return closer;
  } catch (const DataError&) {  // no model that stands: the first look had one
  }
  return first;
}

}  // namespace

WholeDiagnosis diagnose_whole(const Vehicle& vehicle, std::span<const FlightLog> logs,
                              const GapOptions& options, const FlightEntry& entry, const Result& begun) {
  Looked seen;
  if (skip_what_matters(entry.record, logs, entry.p))
    seen.commands.skipped = true;
  else
    seen = looked_at(vehicle, logs, options, entry, begun, Commands::held);
  if (!seen.commands.doubtful()) return seen;
  try {
    Looked open = looked_at(with_open_motors(vehicle, input_interval(entry.record, logs)), logs, options,
                            entry, begun, Commands::open);
    doubt_commands_between_rows(open.result, entry.record, logs, seen.commands);
    doubt_open_motors(open.result, vehicle);
    open.adopted = with_stated_motors(std::move(open.adopted), vehicle);
    return open;
  } catch (const DataError&) {  // no model that stands
    if (seen.commands.skipped) throw;
    doubt_commands_between_rows(seen.result, entry.record, logs, seen.commands);
    return seen;
  }
}

}  // namespace ident
