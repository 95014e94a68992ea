// The causes that show in the balance of the rotors, weighed as those of a whole diagnosis are.
#include "ident/gap/diagnose_trim.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/flight/refine_trim.h"
#include "ident/flight/trim/trim_fit.h"
#include "ident/gap/evidence/causes_tried.h"
#include "ident/gap/search/further.h"
#include "ident/gap/verdict/verdict.h"
#include "ident/gap/views/gap_sections.h"
#include "ident/gap/views/gap_where.h"
#include "ident/gap/views/verdict_json.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Json = nlohmann::ordered_json;

// Information on a direction, in its own unit, below which it does not show in the balance.
constexpr double kShows = 1e-3;
constexpr double kSure = 0.9, kTold = 0.05;
// What is left beside the cause found, or without one, by chance in one of so many cases.
constexpr double kChance = 1e-3;
constexpr std::size_t kMostNames = 3;

// What depends on how the vehicle moves through the air or over the ground needs its attitude; and a tilted
// rotor turns the vehicle as a wrong slant angle or drag does.
bool shows_in_balance(const std::string& cause) {
  const EffectEntry* effect = find_effect(cause);
  constexpr unsigned kSeen = kTouchCentre | kTouchGain | kTouchRotor,
                     kHidden = kTouchFlow | kTouchHeight | kTouchAxis;
  return effect == nullptr || ((effect->info.touches & kSeen) != 0 && (effect->info.touches & kHidden) == 0);
}

// The causes that show. A payload is a shifted centre of gravity and more thrust for a command here, which no
// constants could be told from.
ExtendedProblem problem_of(const FlightRecord& record, const std::vector<double>& p,
                           const std::vector<FreeConstant>& base, const std::vector<std::string>& exclude) {
  ExtendedProblem problem = extended_problem(*record.vehicle, p, record.signals, base, exclude);
  std::erase_if(problem.candidates, [](const Candidate& c) {
    return !shows_in_balance(c.name) || is_lag(c.name) || c.name == "payload";
  });
  return problem;
}

// The quadratic form over all of them, where the base stands.
QuadraticForm form_of(const FlightRecord& record, const Trim& trim, const TrimFit& fit, const Theta& base,
                      ExtendedProblem& problem) {
  std::vector<FreeConstant> constants = problem.constants;
  for (int i = 0; i < problem.base; ++i)
    constants[static_cast<std::size_t>(i)].start = base.physical(fit.fit.u, i);
  const Theta theta(base.p(fit.fit.u), constants, record.logs, false);
  const VectorXd u = VectorXd::Zero(theta.size());
  const MatrixXd Y = trim_slopes(record, trim, theta, u);
  const Eigen::LLT<MatrixXd> V(fit.V);
  QuadraticForm form;
  form.S = Y.transpose() * V.solve(Y);
  form.g = Y.transpose() * V.solve(fit.y);
  form.cost0 = fit.fit.cost;
  form.prior = theta.prior(u);
  const double least = std::sqrt(1e-9);
  form.prior.slope = form.prior.slope.unaryExpr([&](double s) { return std::abs(s) < least ? least : s; });
  form.null = VectorXd::Zero(theta.size());
  form.base = problem.base, form.constants = theta.constants_count();
  const auto hidden = [&](int i) { return form.S(i, i) < kShows; };
  for (Candidate& c : problem.candidates) {
    std::erase_if(c.directions, hidden);
    if (c.height >= 0 && hidden(c.height)) c.height = -1;
  }
  std::erase_if(problem.candidates, [&](const Candidate& c) {
    return c.parameter >= 0 ? hidden(c.parameter) : c.directions.empty();
  });
  return form;
}

struct Fitted {
  FittedModel model;
  TrimFit trim;
};

Fitted fitted(const FlightRecord& record, const Trim& trim, const std::vector<double>& p,
              std::vector<FreeConstant> constants, std::vector<Candidate> adopted,
              const TrimFit* like = nullptr) {
  Fitted out;
  out.model.constants = constants;
  out.model.adopted = std::move(adopted);
  for (const Candidate& c : out.model.adopted)
    if (c.parameter >= 0) {
      FreeConstant& freed = constants[static_cast<std::size_t>(c.parameter)];
      *freed.prior_std *= 100;
      know_alone(constants, freed.index);
    }
  out.model.theta = std::make_shared<Theta>(p, std::move(constants), record.logs, false);
  out.trim = fit_trim(record, trim, *out.model.theta, false, like);
  out.model.fit = out.trim.fit;
  return out;
}

// A load that balance does not tell from the cause found. One beside a rotor asks for the thrust and the
// moments that the rotor would fail to give. Only the moment about z differs, and a tilted rotor or a load in
// its wash changes that one too; see gap/README.md.
struct Load {
  double kg = kNaN, std = kNaN;  ///< NaN where its mass is open: one that shifts the centre of gravity
};
std::optional<Load> load_instead(const FlightRecord& record, const Trim& trim, const Fitted& found,
                                 const std::vector<double>& stated) {
  if (found.model.adopted.empty()) return {};
  const Candidate& cause = found.model.adopted.front();
  if (cause.name == "cg_offset") return Load{};
  if (cause.name != "rotor_mismatch") return {};
  const Theta& theta = *found.model.theta;
  const std::string name = rotor_ratio(static_cast<std::size_t>(cause.rotor) + 1);
  const int ratio = find_parameter(name)->index;
  const auto at = static_cast<std::size_t>(ratio);
  std::vector<double> p = theta.p(found.trim.fit.u);
  const double lost = stated[at] - p[at];
  if (!(lost > 0)) return {};
  const auto& parameters = record.vehicle->parameters;
  const auto known = parameters.find(name);
  double std = known == parameters.end() ? 0.0 : known->second.std.value_or(0.0);
  for (int i = 0; i < theta.constants_count(); ++i)
    if (theta.constants()[static_cast<std::size_t>(i)].index == ratio)
      std = std::hypot(std, theta.deviation(found.trim.fit.u, i, found.trim.fit.covariance));
  const double mass = p[param::m];
  p[at] = stated[at];
  const VectorXd more = unbalance(record, trim, p) - found.trim.y;
  const auto thrust =
      Eigen::Map<const MatrixXd>(more.data(), kTrimChannels, more.size() / kTrimChannels).row(0);
  const double kg = mass * thrust.mean();
  return Load{kg, kg * std / lost};
}

// The load as a cause tried: as probable as what it is not told from.
void enter_load(Json& candidates, const std::string& cause, const Load& load) {
  const auto found = std::ranges::find_if(candidates, [&](const Json& c) { return c["effect"] == cause; });
  if (found == candidates.end()) return;
  (*found)["probability"] = (*found)["probability"].get<double>() / 2;
  Json entry = *found;
  entry["effect"] = "payload", entry["detection_limit"] = entry["parameters"] = Json::object();
  entry["closed"] = nullptr, entry["closed_ci95"] = {nullptr, nullptr};
  if (std::isfinite(load.kg))
    entry["parameters"]["payload.m"] = {{"value", load.kg}, {"std", load.std}, {"unit", "kg"}};
  candidates.insert(found + 1, std::move(entry));
}

double by_chance(const Trim& trim, const TrimFit& fit) {
  return 1 - chi2_cdf(fit.beyond, static_cast<double>(kTrimChannels * trim.logs));
}

// The propeller loss that would have been seen, in words.
std::string limit_of(const Json& candidates) {
  for (const Json& c : candidates)
    if (c["effect"] == "rotor_mismatch")
      for (const auto& [name, limit] : c["detection_limit"].items())
        if (limit.is_number())
          return fmt::format("A rotor would have had to lose {:.0f} % of its thrust to be seen.",
                             100 * limit.get<double>());
  return {};
}

Judged judged(const SearchResult& search, double chance, const std::string& limit,
              const std::optional<Load>& load) {
  Judged out;
  if (search.best.adopted.empty()) {
    out.status = chance < kChance ? "unknown" : "none";
    out.sentence = chance < kChance
                       ? "The rotors do not balance as the model says, and no single cause stands out for "
                         "it. "
                       : "The rotors balance as the model says, within what is known of it. ";
    out.sentence += limit;
    return out;
  }
  const std::string name = search.best.adopted.front().name;
  if (name.starts_with("parameter:")) {
    out.status = "unknown";
    for (const Candidate& c : search.problem.candidates)
      if (c.name.starts_with("parameter:")) out.confused_with.push_back(c.name);
    out.sentence = fmt::format(
        "What the rotors do for a command is not what the model says. Balance does not tell which of its "
        "constants is wrong ({}), nor lift in wind or near the ground, or a load, from them.{}",
        fmt::join(out.confused_with, ", "), chance < kChance ? " And that is not all." : " " + limit);
    return out;
  }
  double own = 0;
  std::vector<std::string> others;
  for (const WeighedSet& set : search.sets) {
    const auto is = [&](int c, const std::string& n) {
      return search.problem.candidates[static_cast<std::size_t>(c)].name == n;
    };
    if (std::ranges::any_of(set.members, [&](int c) { return is(c, name); })) {
      own += set.probability;
      continue;
    }
    for (const int c : set.members)
      if (const std::string& other = search.problem.candidates[static_cast<std::size_t>(c)].name;
          set.probability > kTold && std::ranges::find(others, other) == others.end())
        others.push_back(other);
  }
  if (own > kSure) others.clear();
  if (load) others.emplace_back("payload");
  const std::string found = described(search.best.adopted.front());
  if (chance < kChance || others.size() >= kMostNames) {
    others.insert(others.begin(), name);
    out.status = "unknown", out.confused_with = others;
    out.sentence = fmt::format(
        "The rotors do not balance as the model says, and their balance does not tell why: "
        "nearest {} {}, but that is not all. {}",
        others.size() == 1 ? "is" : "are", fmt::join(others, ", "), limit);
    return out;
  }
  out.effects = {name}, out.confused_with = others;
  out.status = others.empty() ? "identified" : "ambiguous";
  out.sentence = fmt::format("The balance of the rotors differs from the model by {}", found);
  if (load && std::isfinite(load->kg))
    others.back() = fmt::format("a payload of {} kg at that rotor", format_number(load->kg, 2));
  out.sentence += others.empty()
                      ? "."
                      : fmt::format(", but {} would explain it about as well.", fmt::join(others, " or "));
  if (load) out.sentence += " Put the vehicle on a scale.";
  return out;
}

// What is left as force and moment, a row for each stretch.
ResidualWrench wrench_of(const FlightRecord& record, const Trim& trim, const TrimFit& fit) {
  ResidualWrench out;
  out.names = {"Fz", "Mx", "My", "Mz"};
  const auto n = static_cast<Index>(trim.stretches.size());
  const Eigen::Vector4d unit(-trim.weight, trim.weight * trim.reach, trim.weight * trim.reach,
                             trim.weight * trim.reach);
  out.residual = MatrixXd::Zero(n, kTrimChannels);
  VectorXd voltage = VectorXd::Ones(n);
  Eigen::Vector4d square = Eigen::Vector4d::Zero();
  for (Index k = 0; k < n; ++k) {
    const TrimStretch& s = trim.stretches[static_cast<std::size_t>(k)];
    out.t.push_back(s.t), out.log.push_back(s.log);
    // What the flight shows beyond the model.
    out.residual.row(k) = -fit.y.segment<kTrimChannels>(kTrimChannels * k).cwiseProduct(unit).transpose();
    for (Index c = 0; c < kTrimChannels; ++c)
      square[c] += fit.V(kTrimChannels * k + c, kTrimChannels * k + c);
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(s.arc)];
    if (record.signals.voltage && !arc.inputs->voltage_ratio.empty())
      voltage[k] = arc.inputs->voltage_ratio[(s.begin + s.end) / 2];
  }
  out.noise = (square / static_cast<double>(n)).cwiseSqrt().cwiseProduct(unit.cwiseAbs());
  if (record.signals.voltage) out.regimes.emplace_back("voltage", voltage);
  return out;
}

}  // namespace

void diagnose_trim(Diagnosis& out, const FlightRecord& record, const std::vector<double>& p,
                   const std::vector<std::string>& exclude) {
  Result& result = out.result;
  const Vehicle& vehicle = *record.vehicle;
  const std::vector<FreeConstant> constants = trim_constants(record, p);
  const Trim trim = make_trim(record, p);
  Fitted base = fitted(record, trim, p, constants, {});
  SearchResult search;
  search.base = base.model;
  search.problem = problem_of(record, p, constants, exclude);
  search.form = form_of(record, trim, base.trim, *base.model.theta, search.problem);
  search.base_problem = search.problem, search.base_form = search.form;
  const Standing at{base.model, search.problem, search.form, {}};
  search.sets = weighed_sets(at);
  Further best;
  for (std::size_t c = 0; c < search.problem.candidates.size(); ++c)
    if (const Further one = further(at, {}, static_cast<int>(c)); one.passes() && one.gain > best.gain)
      best = one;
  search.best = base.model;
  TrimFit left = base.trim;
  std::optional<Load> load;
  if (best.candidate >= 0) {
    const Candidate& cause = search.problem.candidates[static_cast<std::size_t>(best.candidate)];
    std::vector<FreeConstant> more = constants;
    for (FreeConstant c : constants_of(cause, vehicle, p, record.signals))
      c.adopted = true, more.push_back(c);
    Fitted with = fitted(record, trim, p, std::move(more), {cause}, &base.trim);
    search.best = with.model, left = with.trim;
    load = load_instead(record, trim, with, p);
    search.steps = search.alone = {{described(cause), best.honest()}};
  }
  const ResidualWrench before = wrench_of(record, trim, base.trim), after = wrench_of(record, trim, left);
  Json candidates = causes_tried(search, [](const Candidate&) { return GapClosed{}; });
  const Judged& verdict = out.verdict = judged(search, by_chance(trim, left), limit_of(candidates), load);
  if (load) enter_load(candidates, search.best.adopted.front().name, *load);
  result.warnings.push_back(without_turning());
  if (!states_rotor_ratios(vehicle))
    result.warn(
        "rotors_unknown",
        "how equal the rotors of this vehicle are when nothing is wrong is not stated: 10 % is assumed. "
        "Refine with flights of the vehicle as it should be, and diagnose against that");
  result.parameters = flight_parameters(*search.best.theta, search.best.fit, "gap");
  result.extra["verdict"] = to_json(verdict, after);
  result.extra["where"] = where_json(before);
  result.extra["candidates"] = candidates;
  result.extra["not_tried"] = causes_not_tried(search, vehicle, exclude);
  result.extra["gap"] = {{"before", nullptr},
                         {"after", nullptr},
                         {"noise_floor", nullptr},
                         {"closed", nullptr},
                         {"closed_ci95", {nullptr, nullptr}},
                         {"horizons", Json::array()},
                         {"forces", nullptr},
                         {"moments", nullptr},
                         {"open_loop", nullptr},
                         {"rotor_speeds", nullptr}};
  result.extra["balance"] = {{"stretches", trim.stretches.size()},
                             {"rotor_scatter", base.trim.scatter.rotor},
                             {"level_scatter", base.trim.scatter.level},
                             {"beyond", base.trim.beyond},
                             {"left", left.beyond},
                             {"by_chance", by_chance(trim, left)}};
  result.verdict = verdict.sentence;
  result.sections = {trim_section(record, trim, left.y)};
  result.sections.back().text += " " + scatter_in_words(trim, left.scatter);
  std::ranges::move(gap_sections(result.extra, before, after), std::back_inserter(result.sections));
  out.adopted = adopted_vehicle(vehicle, search.best);
}

}  // namespace ident
