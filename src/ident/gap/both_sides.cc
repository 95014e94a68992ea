// Joins what was found of forces and of moments.
#include "ident/gap/both_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "ident/core/word_list.h"
#include "ident/flight/ladder/ladder.h"

namespace ident {
namespace {

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

}  // namespace

bool Side::explained() const { return missed < kExplains; }

bool is_told(const Side& side, const std::string& name) {
  const ExtendedProblem& problem = side.search.result.problem;
  for (int i = 0; i < problem.base; ++i)
    if (problem.constants[static_cast<std::size_t>(i)].name == name)
      return side.search.result.form.S(i, i) >= kHidden;
  return false;
}

bool is_sure(const Judged& verdict) { return verdict.status == "identified" || verdict.status == "partly"; }

bool tells(const Side& moments, const Side* forces, const FreeConstant& c) {
  return (moments.explained() || c.adopted) && !(forces && is_told(*forces, c.name));
}

// Moments are explained worse, and would bend what forces tell.
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

Vehicle held_at(Vehicle vehicle, const Side& forces) {
  constexpr double kHeld = 0.01;  // of its deviation
  for (auto& [name, known] : vehicle.parameters)
    if (known.std && is_told(forces, name)) known.std = kHeld * *known.std;
  vehicle.correlation = {};
  return vehicle;
}

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

}  // namespace ident
