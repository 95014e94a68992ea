// Search, shares and rival over windows, judged as those of whole models are.
#include "ident/gap/diagnose_windows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "ident/core/stage_times.h"
#include "ident/core/word_list.h"
#include "ident/flight/checks/gusts_expected.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/fit/fitted_parameters.h"
#include "ident/flight/record/excerpts.h"
#include "ident/gap/evidence/causes_tried.h"
#include "ident/gap/evidence/motion_errors.h"
#include "ident/gap/verdict/decision.h"
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

constexpr double kExplains = 0.7;  // of what was gained: half of its square is explained

// Of forces or of moments: what was found, and what is said of it.
struct Side {
  Side(const FlightRecord& record, FitTo what, std::vector<std::string> settled)
      : model(record, what, std::move(settled)) {}
  WindowModel model;
  WindowSearch search;
  std::vector<Parameter> parameters;
  WindowShares shares;
  Judged verdict;
  GapClosed gap;

  double missed = 0;  // share of the rates gained over a window that the model misses; 0 of forces

  bool explained() const { return missed < kExplains; }
};

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

// Causes that forces can tell, whether or not they were found there.
std::vector<std::string> tried_on(const Side& side) {
  std::vector<std::string> names;
  for (const Candidate& c : side.search.result.base_problem.candidates) names.push_back(c.name);
  return names;
}

// Whether windows of that side tell something of a constant.
bool is_told(const Side& side, const std::string& name) {
  const ExtendedProblem& problem = side.search.result.problem;
  for (int i = 0; i < problem.base; ++i)
    if (problem.constants[static_cast<std::size_t>(i)].name == name)
      return side.search.result.form.S(i, i) >= kHidden;
  return false;
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

// None where that side was not logged, or no model of it stands. Of what `told` tells, causes and constants,
// nothing is said again.
std::unique_ptr<Side> diagnosed(const FlightRecord& record, FitTo what, const Vehicle& vehicle,
                                const std::vector<double>& p, const GapOptions& options, const Side* told) {
  auto side = std::make_unique<Side>(record, what, told ? tried_on(*told) : std::vector<std::string>{});
  if (!side->model.tells()) return {};
  side->search = search_windows(side->model, vehicle, p, options.exclude, options.most_causes);
  const SearchResult& found = side->search.result;
  if (!stands(found.best)) return {};
  side->parameters = flight_parameters(*found.best.theta, found.best.fit, "gap");
  if (told) std::erase_if(side->parameters, [&](const Parameter& one) { return is_told(*told, one.name); });
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
  side->verdict = settled(judge({found, seen, side->shares.shares, rival, {}, {}, {}, side->parameters}));
  return side;
}

// Constants that forces tell keep what these say: moments are explained worse, and would bend them.
std::vector<Parameter> all_parameters_of(const Side* forces, const Side* moments) {
  if (!forces) return moments->parameters;
  std::vector<Parameter> out = forces->parameters;
  if (!moments) return out;
  for (const Parameter& other : moments->parameters) {
    const bool of_effect = other.name.find('.') != std::string::npos;
    if (!moments->explained() && !of_effect) continue;
    const auto known = std::ranges::find(out, other.name, &Parameter::name);
    if (known == out.end())
      out.push_back(other);
    else
      *known = other;
  }
  return out;
}

// What forces tell is not moved by moments.
Vehicle held_at(Vehicle vehicle, const Side& forces) {
  constexpr double kHeld = 0.01;  // of its deviation
  for (auto& [name, known] : vehicle.parameters)
    if (known.std && is_told(forces, name)) known.std = kHeld * *known.std;
  vehicle.correlation = {};
  return vehicle;
}

bool is_sure(const Judged& verdict) { return verdict.status == "identified" || verdict.status == "partly"; }

void append(std::vector<std::string>& names, const std::vector<std::string>& more) {
  for (const std::string& name : more)
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

// Of inertia that inputs do not tell nothing is said.
std::string sentence_of(const Side& moments) {
  if (moments.explained()) return moments.verdict.sentence;
  std::string out = "What was logged of the rotors does not explain how the vehicle turned: inertia is open.";
  if (moments.verdict.effects.empty()) return out;
  return fmt::format("There is {}. {}", listed(moments.verdict.effects), out);
}

// What both sides say. Of a side that is not sure beside one that is, only the sentence speaks.
Judged together(const Side* forces, const Side* moments) {
  if (!forces || !moments) return (forces ? forces : moments)->verdict;
  const bool by_forces = !forces->verdict.effects.empty() || moments->verdict.effects.empty();
  Judged out = by_forces ? forces->verdict : moments->verdict;
  const Judged other = by_forces ? moments->verdict : forces->verdict;
  std::ranges::copy(other.causes, std::back_inserter(out.causes));
  if (moments->explained())
    std::ranges::copy(other.findings, std::back_inserter(out.findings));
  else if (!by_forces)
    out.findings = other.findings;
  const bool sure = is_sure(out) || is_sure(other);
  if (sure && !is_sure(out)) out.effects.clear(), out.confused_with.clear();
  if (is_sure(other) || (!sure && other.status == "ambiguous")) {
    append(out.effects, other.effects);
    append(out.confused_with, other.confused_with);
  }
  if (out.status != other.status)
    out.status = sure ? "partly" : out.effects.empty() ? "unknown" : "ambiguous";
  std::erase_if(out.confused_with, [&](const std::string& name) {
    return std::ranges::find(out.effects, name) != out.effects.end();
  });
  out.sentence = "Forces: " + forces->verdict.sentence + " Moments: " + sentence_of(*moments);
  return out;
}

// Whether moments tell a constant: their causes always, what else only where the inputs explain them.
bool tells(const Side& moments, const Side* forces, const FreeConstant& c) {
  return (moments.explained() || c.adopted) && !(forces && is_told(*forces, c.name));
}

// The vehicle with what either side found. Constants that forces tell stay what these say.
Vehicle adopted_of(const Vehicle& vehicle, const Side* forces, const Side* moments) {
  const auto by = [](const Side& side, const Vehicle& from) {
    const SearchResult& found = side.search.result;
    return adopted_vehicle(from, side.verdict.status == "none" ? found.base : found.best);
  };
  if (!forces) return by(*moments, vehicle);
  Vehicle out = by(*forces, vehicle);
  if (!moments) return out;
  const Vehicle more = by(*moments, held_at(out, *forces));
  for (const FreeConstant& c : moments->search.result.best.constants)
    if (const auto at = more.parameters.find(c.name);
        at != more.parameters.end() && tells(*moments, forces, c))
      out.parameters[c.name] = at->second;
  return out;
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
  const Vehicle vehicle = found_before ? with_found(stated, *found_before) : stated;
  const std::vector<double> start = found_before ? with_found(entry.p, *found_before) : entry.p;
  const std::unique_ptr<Side> forces = diagnosed(record, FitTo::forces, vehicle, start, options, nullptr);
  Vehicle known = vehicle;
  std::vector<double> p = start;
  if (forces) {
    const FittedModel& best = forces->search.result.best;
    known = held_at(adopted_vehicle(vehicle, best), *forces), p = best.theta->p(best.fit.u);
  }
  const std::unique_ptr<Side> moments = diagnosed(record, FitTo::moments, known, p, options, forces.get());
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
  Json gap = gap_json(
      motion_errors(held_out_of(record, kTrainingShare), {entry.p, out.trained, no_bias, record.sigma}));
  out.gap = closed_of(gap);
  result.extra["gap"] = std::move(gap);
  result.extra["gap"]["without_causes"] = number_or_null(main.shares.shares.without_causes);
  result.sections = gap_sections(result.extra, before, after);
  result.sections.push_back(data_health(record, logs, initial_noise(record), entry.vibration));
  out.adopted = adopted_of(vehicle, forces.get(), moments.get());
  out.verdict = std::move(verdict);
  return out;
}

}  // namespace ident
