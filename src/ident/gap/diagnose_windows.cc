// Search, shares and rival over windows, judged as those of whole models are.
#include "ident/gap/diagnose_windows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "ident/core/stage_times.h"
#include "ident/flight/checks/command_rate.h"
#include "ident/flight/checks/gusts_expected.h"
#include "ident/flight/checks/intersample_commands.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/fit/fitted_parameters.h"
#include "ident/flight/fit/loop_timing.h"
#include "ident/flight/record/excerpts.h"
#include "ident/gap/both_sides.h"
#include "ident/gap/evidence/causes_tried.h"
#include "ident/gap/evidence/motion_errors.h"
#include "ident/gap/verdict/decision.h"
#include "ident/gap/verdict/open_commands.h"
#include "ident/gap/verdict/verdict_sentence.h"
#include "ident/gap/views/gap_sections.h"
#include "ident/gap/views/gap_where.h"
#include "ident/gap/views/verdict_json.h"
#include "ident/gap/windows/window_rival.h"
#include "ident/gap/windows/window_shares.h"
#include "ident/result/json_number.h"
#include "ident/views/data_health.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

// Of the rates gained over windows, the share that a model misses; of no model at all 1.
double missed_share(const WindowModel& model, double missed) {
  double square = 0;
  for (const Window& w : model.windows()) {
    const std::vector<BodyState<double>>& body = model.motion().arcs[w.arc].body;
    square += (body[w.end].w_B - body[w.begin].w_B).squaredNorm();
  }
  return missed / std::sqrt(square / static_cast<double>(model.windows().size()));
}

GapClosed closed_of(const WindowShares& of) {
  GapClosed out;
  if (!(of.floor > 0)) return out;
  out.before = of.before / of.floor, out.after = of.after / of.floor, out.floor = 1.0;
  out.closed = 1 - of.shares.remaining.value;
  out.ci95 = {1 - of.shares.remaining.ci95[1], 1 - of.shares.remaining.ci95[0]};
  return out;
}

// Of an ambiguous verdict the causes that are certain by themselves, where there are such: what else could be
// in the place of the others takes nothing from them.
Judged settled(Judged verdict) {
  if (verdict.status != "ambiguous") return verdict;
  std::vector<std::string> open;
  for (const JudgedCause& cause : verdict.causes)
    if (cause.probability() < kNamed) open.push_back(cause.evidence.name);
  Judged certain = unnamed(verdict, open);
  if (certain.effects.empty()) return verdict;
  certain.status = "partly";
  return certain;
}

// Causes that forces can tell, whether or not they were found there.
std::vector<std::string> tried_on(const Side& side) {
  std::vector<std::string> names;
  for (const Candidate& c : side.search.result.base_problem.candidates) names.push_back(c.name);
  return names;
}

// Time between commands, s, where a controller may have gone on in between, as far as logs tell.
std::optional<double> open_commands(const FlightRecord& record, std::span<const FlightLog> logs,
                                    const std::vector<double>& p) {
  if (!record.signals.commands) return {};
  const bool rarer = loop_of(logs) == 0 && std::ranges::any_of(logs, commands_are_rarer_than_rates);
  if (!rarer && !skip_what_matters(record, logs, p) && !hides_motion(record, logs)) return {};
  return input_interval(record, logs);
}

// None where that side was not logged, or no model of it stands. Of what `told` tells, causes and constants,
// nothing is said again. `open`: time between commands, s, where a controller went on in between.
std::unique_ptr<Side> diagnosed(const FlightRecord& record, FitTo what, const Vehicle& vehicle,
                                const std::vector<double>& p, const GapOptions& options, const Side* told,
                                std::optional<double> open) {
  auto side = std::make_unique<Side>(record, what, told ? tried_on(*told) : std::vector<std::string>{});
  if (!side->model.tells()) return {};
  side->search = search_windows(side->model, vehicle, p, options.exclude, options.most_causes);
  const SearchResult& found = side->search.result;
  if (!stands(found.best)) return {};
  side->parameters = flight_parameters(*found.best.theta, found.best.fit, "gap");
  if (told) std::erase_if(side->parameters, [&](const Parameter& one) { return is_told(*told, one.name); });
  if (open) doubt_open_motors(side->parameters);
  side->shares = window_shares(side->model, side->search);
  side->gap = closed_of(side->shares);
  // Air is no discrepancy; windows are shorter than its gusts.
  GapClosed seen = side->gap;
  if (what == FitTo::forces) {
    const double air = gusts_expected(record).force / record.p[param::m] * horizon_of(what);
    seen.floor = std::hypot(1.0, air / side->shares.floor);
  }
  const Rival rival = window_rival(side->model, side->search.best);
  if (what == FitTo::moments) side->missed = missed_share(side->model, side->shares.after);
  const Seen rests_on{found, seen, side->shares.shares, rival, {}, {}, {}, side->parameters, true};
  side->verdict = settled(judge(rests_on));
  if (open)
    side->verdict = with_open_commands(std::move(side->verdict), side->parameters, *open,
                                       [&](const Judged& left) { return sentence_of(left, rests_on); });
  return side;
}

Json candidates_of(const Side* forces, const Side* moments, const Judged& verdict) {
  Json out = Json::array();
  for (const Side* side : {forces, moments}) {
    if (!side) continue;
    for (Json& entry : causes_tried(side->search.result, [](const Candidate&) { return GapClosed{}; }))
      out.push_back(std::move(entry));
  }
  enter_causes(out, verdict);
  return out;
}

// What is missed with what else moves as measured, over the noise of the sensors.
Json gap_json(const Json& motion) {
  Json out = {{"before", nullptr},
              {"after", nullptr},
              {"noise_floor", nullptr},
              {"closed", nullptr},
              {"closed_ci95", {nullptr, nullptr}},
              {"horizons", Json::array()}};
  const Json& shown = motion["forces"].is_object() ? motion["forces"] : motion["moments"];
  if (shown.is_object())
    for (const Json& h : shown["horizons"]) {
      if (!h["before"].is_number() || !h["after"].is_number() || !h["noise_floor"].is_number()) continue;
      const double floor = std::max(h["noise_floor"].get<double>(), 1e-9);
      Json one = {{"before", h["before"].get<double>() / floor},
                  {"after", h["after"].get<double>() / floor},
                  {"noise_floor", 1.0},
                  {"closed", h["closed"]},
                  {"closed_ci95", {nullptr, nullptr}}};
      if (h["seconds"] == kJudgedHorizon) out.update(one);
      out["horizons"].push_back({{"horizon", h["seconds"]}});
      out["horizons"].back().update(one);
    }
  out.update(motion);
  return out;
}

GapClosed closed_of(const Json& gap) {
  GapClosed out;
  if (!gap["before"].is_number()) return out;
  out.before = gap["before"], out.after = gap["after"], out.floor = gap["noise_floor"];
  if (gap["closed"].is_number()) out.closed = gap["closed"];
  return out;
}

// Constants of a model by the first part of the flight.
std::vector<double> trained_by_part(const FlightRecord& part, FitTo what, const Vehicle& vehicle,
                                    const std::vector<std::string>& exclude, const std::vector<double>& p,
                                    const FittedModel& of_all) {
  const WindowModel model(part, what);
  if (model.tells()) {
    const FittedModel trained =
        model.standing(vehicle, exclude, of_all.constants, of_all.adopted, p).at.model;
    if (trained.fit.converged) return trained.theta->p(trained.fit.u);
  }
  return of_all.theta->p(of_all.fit.u);
}

// The same with what moments add to it.
std::vector<double> with_moments(std::vector<double> p, const Side* forces,
                                 const std::vector<double>& of_moments, const Side& moments) {
  for (const FreeConstant& c : moments.search.result.best.constants)
    if (tells(moments, forces, c))
      p[static_cast<std::size_t>(c.index)] = of_moments[static_cast<std::size_t>(c.index)];
  return p;
}

}  // namespace

std::optional<WindowDiagnosis> diagnose_windows(const Vehicle& stated, std::span<const FlightLog> logs,
                                                const GapOptions& options, const FlightEntry& entry,
                                                const Result& begun,
                                                const std::optional<FoundByLadder>& found_before) {
  const Stage stage("along measured motion");
  const FlightRecord& record = entry.record;
  const std::optional<double> open = open_commands(record, logs, entry.p);
  const Vehicle begin = open ? with_open_motors(stated, *open) : stated;
  const Vehicle vehicle = found_before ? with_found(begin, *found_before) : begin;
  const std::vector<double> start = found_before ? with_found(entry.p, *found_before) : entry.p;
  const std::unique_ptr<Side> forces =
      diagnosed(record, FitTo::forces, vehicle, start, options, nullptr, open);
  Vehicle known = vehicle;
  std::vector<double> p = start;
  if (forces) {
    const FittedModel& best = forces->search.result.best;
    known = held_at(adopted_vehicle(vehicle, best), *forces), p = best.theta->p(best.fit.u);
  }
  const std::unique_ptr<Side> moments =
      diagnosed(record, FitTo::moments, known, p, options, forces.get(), open);
  if (!forces && !moments) return {};
  WindowDiagnosis out;
  Result& result = out.result;
  result = begun;
  result.parameters = all_parameters_of(forces.get(), moments.get());
  Judged verdict = together(forces.get(), moments.get());
  if (found_before) {
    result.parameters = with_found(std::move(result.parameters), *found_before);
    verdict = with_found(std::move(verdict), *found_before);
  }
  if (open) doubt_open_motors(result, stated);
  const Side& main =
      forces && (!moments || !forces->verdict.effects.empty() || moments->verdict.effects.empty()) ? *forces
                                                                                                   : *moments;
  const ResidualWrench before = wrench_of(main.model, main.search.base),
                       after = wrench_of(main.model, main.search.best);
  const FlightRecord part = training_of(record, kTrainingShare);
  out.trained = out.without_causes = start;
  if (forces) {
    const SearchResult& found = forces->search.result;
    const auto trained = [&](const FittedModel& model) {
      return trained_by_part(part, FitTo::forces, vehicle, options.exclude, start, model);
    };
    out.trained = trained(found.best), out.without_causes = trained(found.base);
    if (is_sure(forces->verdict)) out.of_forces = forces->verdict.effects;
  }
  if (moments) {
    const FittedModel& best = moments->search.result.best;
    out.trained = with_moments(
        out.trained, forces.get(),
        trained_by_part(part, FitTo::moments, known, options.exclude, out.trained, best), *moments);
  }
  if (found_before) {
    out.trained = by_first_part(std::move(out.trained), *found_before);
    out.without_causes = by_first_part(std::move(out.without_causes), *found_before);
  }
  result.verdict = verdict.sentence;
  result.extra["by"] = "measured_motion";
  result.extra["verdict"] = to_json(verdict, after);
  result.extra["where"] = where_json(before);
  result.extra["candidates"] = candidates_of(forces.get(), moments.get(), verdict);
  result.extra["not_tried"] = causes_not_tried(main.search.result, vehicle, options.exclude);
  const std::vector<std::array<double, 3>> no_bias(static_cast<std::size_t>(record.logs));
  const auto gap_of = [&](const std::vector<double>& found) {
    return gap_json(
        motion_errors(held_out_of(record, kTrainingShare), {entry.p, found, no_bias, record.sigma}));
  };
  Json gap = gap_of(out.trained);
  out.gap = closed_of(gap);
  gap["without_causes"] = number_or_null(forces ? closed_of(gap_of(out.without_causes)).after : kNaN);
  result.extra["gap"] = std::move(gap);
  result.sections = gap_sections(result.extra, before, after);
  result.sections.push_back(data_health(record, logs, initial_noise(record), entry.vibration));
  out.adopted = adopted_of(vehicle, forces.get(), moments.get());
  if (open) out.adopted = with_stated_motors(std::move(out.adopted), stated);
  out.verdict = std::move(verdict);
  return out;
}

}  // namespace ident
