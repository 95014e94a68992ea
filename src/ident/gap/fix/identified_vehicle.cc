// Takes over identified constants with their correlations.
#include "ident/gap/fix/identified_vehicle.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "ident/gap/verdict/decision.h"

namespace ident {
namespace {

bool is_identified(const Parameter& p) { return p.identifiable || p.joint; }

// A drag known with the rotor speed only is not identified by itself, and is there.
bool is_told(const Parameter& p, const std::vector<std::string>& effects) {
  if (is_identified(p)) return true;
  const std::size_t dot = p.name.find('.');
  if (dot != std::string::npos)
    return std::isfinite(p.value) && std::ranges::find(effects, p.name.substr(0, dot)) != effects.end();
  return p.prior_value && p.from_flight.value_or(0.0) > kHeard;
}

}  // namespace

Vehicle identified_vehicle(const Vehicle& stated, const Diagnosis& diagnosis) {
  Vehicle out = stated;
  if (std::ranges::none_of(diagnosis.result.parameters, is_identified)) return out;
  std::set<std::string> taken;
  for (const auto& [name, known] : diagnosis.adopted.parameters) {
    const Parameter* found = diagnosis.result.find(name);
    if (!found || !is_told(*found, diagnosis.verdict.effects)) continue;
    out.parameters[name] = known;
    taken.insert(name);
  }
  const auto is_taken = [&](const std::string& name) { return taken.contains(name); };
  out.correlation = stated.correlation.renewed(diagnosis.adopted.correlation.part(is_taken), is_taken);
  for (Rotor& rotor : out.rotors) rotor.a_B = axis_at(rotor, slant_angle(out));
  return out;
}

}  // namespace ident
