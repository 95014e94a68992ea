// Constants of the rung that was taken, and what is contradicted beyond chance.
#include "ident/gap/found_by_ladder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/effects/all_parameters.h"
#include "ident/gap/verdict/decision.h"
#include "ident/views/chosen_rung.h"

namespace ident {
namespace {

constexpr std::size_t kHalfSecond = 1;  // of kLadderHorizons
constexpr double kCloses = 0.5;         // of the error as stated: the motors are most of it

// A battery that the vehicle file does not state, and the speeds show.
bool is_new_effect(const Parameter& p) {
  return !p.prior_value && !p.joint && find_effect_parameter(p.name) &&
         std::abs(p.value - default_value(p.name)) > kBeyondChance * p.std;
}

}  // namespace

std::optional<FoundByLadder> found_by_ladder(const LadderResult& ladder) {
  const auto error = [](const RungResult& rung) {
    return rung.error[static_cast<std::size_t>(Metric::rotor_speed)][kHalfSecond];
  };
  const RungResult& chosen = ladder.rungs[ladder.chosen];
  FoundByLadder out{{}, chosen.trained, error(ladder.rungs.front()), error(chosen)};
  for (const RungConstant& c : chosen.constants)
    if (c.of == FitTo::speeds || stands_for_lasting_moment(c)) out.parameters.push_back(parameter_of(c));
  if (out.parameters.empty()) return {};
  return out;
}

Vehicle with_found(Vehicle vehicle, const FoundByLadder& found) {
  for (const Parameter& p : found.parameters) vehicle.parameters[p.name] = {p.value, p.std};
  return vehicle;
}

std::vector<double> with_found(std::vector<double> p, const FoundByLadder& found) {
  for (const Parameter& one : found.parameters)
    p[static_cast<std::size_t>(find_parameter(one.name)->index)] = one.value;
  return p;
}

std::vector<double> by_first_part(std::vector<double> p, const FoundByLadder& found) {
  for (const Parameter& one : found.parameters) {
    const auto at = static_cast<std::size_t>(find_parameter(one.name)->index);
    p[at] = found.trained[at];
  }
  return p;
}

std::vector<Parameter> with_found(std::vector<Parameter> parameters, const FoundByLadder& found) {
  std::erase_if(parameters, [&](const Parameter& p) {
    return std::ranges::find(found.parameters, p.name, &Parameter::name) != found.parameters.end();
  });
  parameters.insert(parameters.end(), found.parameters.begin(), found.parameters.end());
  return parameters;
}

Judged with_found(Judged verdict, const FoundByLadder& found) {
  std::vector<std::string> names, said;
  for (const Contradiction& one : contradictions(found.parameters, {})) {
    names.push_back("parameter:" + one.constant), said.push_back(in_words(one));
    verdict.findings.push_back(one);
  }
  for (const Parameter& p : found.parameters)
    if (is_new_effect(p)) {
      names.push_back(p.name.substr(0, p.name.find('.')));
      said.push_back(fmt::format("{} is {}", p.name, format_with_uncertainty(p.value, p.std)));
    }
  // Within what was stated of them they are no causes, and yet what the simulator has to be told.
  const bool closes = found.now < kCloses * found.as_stated;
  for (const Parameter& p : found.parameters)
    if (names.empty() && closes && p.identifiable)
      said.push_back(fmt::format("{} is {} {}", p.name, format_with_uncertainty(p.value, p.std), p.unit));
  if (said.empty()) return verdict;
  const bool sure = verdict.status == "identified" || verdict.status == "partly";
  if (!sure && !names.empty()) {
    verdict.effects.clear(), verdict.confused_with.clear();
    verdict.status = verdict.status == "none" ? "identified" : "partly";
  }
  verdict.effects.insert(verdict.effects.begin(), names.begin(), names.end());
  verdict.sentence = fmt::format(
      "Rotor speeds for their commands: {}; after half a second of held-out flight they are missed by {} "
      "rad/s, not by {} as stated. {}",
      fmt::join(said, ", "), format_number(found.now, 3), format_number(found.as_stated, 3),
      verdict.sentence);
  return verdict;
}

}  // namespace ident
