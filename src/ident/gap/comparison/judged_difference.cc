// Names, status and sentence of a comparison.
#include "ident/gap/comparison/judged_difference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ident/core/format_number.h"
#include "ident/effects/all_parameters.h"
#include "ident/gap/verdict/decision.h"

namespace ident {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

// What else a side takes a cause for.
void add_confused(const Diagnosis& side, const std::string& cause, Judged& out) {
  if (!contains(side.verdict.effects, cause)) return;
  for (const std::string& other : side.verdict.confused_with)
    if (!contains(out.confused_with, other)) out.confused_with.push_back(other);
}

// "m 0.500 ± 0.003 kg flown, 0.460 ± 0.002 kg simulated".
std::string sizes(const ComparedCause& cause) {
  Names out;
  for (const ComparedConstant& c : cause.constants) {
    const std::string unit = parameter_unit(c.name);
    out.push_back(fmt::format("{} {} flown, {} simulated{}", c.name,
                              format_with_uncertainty(c.real, c.real_std),
                              format_with_uncertainty(c.simulated, c.simulated_std),
                              unit.empty() || unit == "-" ? "" : ", in " + unit));
  }
  return fmt::format("{} ({})", cause.name, fmt::join(out, "; "));
}

std::string left_sentence(const Sides& sides) {
  std::string out;
  for (const auto& [side, of] : {std::pair(&sides.real, "real"), {&sides.simulated, "simulated"}})
    if (has_rest(*side)) out += fmt::format(" Of the {} log: {}", of, side->verdict.sentence);
  if (!sides.not_shown.empty())
    out += fmt::format(" Not compared, because one of the logs cannot show it: {}.",
                       fmt::join(sides.not_shown, ", "));
  return out;
}

std::string sentence_of(const Judged& verdict, const std::vector<ComparedCause>& causes) {
  if (verdict.effects.empty())
    return verdict.status == "none"
               ? "Both logs follow the same model within chance: no constant and no effect differs."
               : "No constant and no effect is certain to differ.";
  Names told;
  for (const ComparedCause& cause : causes)
    if (cause.differs) told.push_back(sizes(cause));
  std::string out = fmt::format("Real and simulated flight differ in {}.", fmt::join(told, " and in "));
  if (!verdict.confused_with.empty())
    out += fmt::format(" {} would explain it about as well.", fmt::join(verdict.confused_with, " or "));
  return out;
}

}  // namespace

bool has_rest(const Diagnosis& side) {
  return side.verdict.status == "partly" || side.verdict.status == "unknown";
}

std::vector<Candidate> named_causes(const Diagnosis& diagnosis, const Vehicle& stated) {
  std::vector<Candidate> out;
  for (const std::string& name : diagnosis.verdict.effects) {
    std::set<int> rotors;
    for (const auto& [constant, known] : diagnosis.adopted.parameters) {
      const std::size_t at = constant.find('@');
      const bool is_new = !stated.has(constant) || stated.value(constant) != known.value;
      if (at != std::string::npos && constant.starts_with(name + ".") && is_new)
        rotors.insert(std::stoi(constant.substr(at + 1)) - 1);
    }
    if (rotors.empty()) rotors.insert(-1);
    for (const int rotor : rotors) {
      Candidate cause{.name = name};
      cause.rotor = rotor;
      out.push_back(cause);
    }
  }
  return out;
}

std::set<std::string> material_causes(const Diagnosis& diagnosis) {
  std::set<std::string> out;
  for (const JudgedCause& cause : diagnosis.verdict.causes) {
    const std::string& name = cause.evidence.name;
    const bool immaterial = cause.share.value <= kMaterial;  // not where the share is unknown
    if (contains(diagnosis.verdict.effects, name) && !immaterial) out.insert(name);
  }
  return out;
}

Judged judged_difference(const Sides& sides, const std::vector<ComparedCause>& causes) {
  Judged out;
  for (const ComparedCause& cause : causes)
    if (cause.differs) out.effects.push_back(cause.name);
  for (const ComparedCause& cause : causes) {
    if (!cause.differs) continue;
    for (const std::string& other : cause.alternatives)
      if (!contains(out.confused_with, other)) out.confused_with.push_back(other);
    add_confused(sides.real, cause.name, out);
    add_confused(sides.simulated, cause.name, out);
  }
  std::erase_if(out.confused_with, [&](const std::string& name) { return contains(out.effects, name); });
  const bool rest = has_rest(sides.real) || has_rest(sides.simulated) || !sides.not_shown.empty();
  if (out.effects.empty())
    out.status = rest ? "unknown" : "none";
  else if (!out.confused_with.empty())
    out.status = "ambiguous";
  else
    out.status = rest ? "partly" : "identified";
  out.sentence = sentence_of(out, causes) + left_sentence(sides);
  return out;
}

}  // namespace ident
