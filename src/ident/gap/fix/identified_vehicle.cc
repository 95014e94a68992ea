// Takes over identified constants with their correlations.
#include "ident/gap/fix/identified_vehicle.h"

#include <algorithm>
#include <set>

namespace ident {
namespace {

// Share of what is known of a constant that the flights must have told. [-] As for a contradiction.
constexpr double kHeard = 0.05;

bool is_identified(const Parameter& p) { return p.identifiable || p.joint; }

bool is_told(const Parameter& p) {
  const bool of_an_effect = p.name.find('.') != std::string::npos;
  return is_identified(p) || (!of_an_effect && p.prior_value && p.from_flight.value_or(0.0) > kHeard);
}

}  // namespace

Vehicle identified_vehicle(const Vehicle& stated, const Diagnosis& diagnosis) {
  Vehicle out = stated;
  if (std::ranges::none_of(diagnosis.result.parameters, is_identified)) return out;
  std::set<std::string> taken;
  for (const auto& [name, known] : diagnosis.adopted.parameters) {
    const Parameter* found = diagnosis.result.find(name);
    if (!found || !is_told(*found)) continue;
    out.parameters[name] = known;
    taken.insert(name);
  }
  const auto is_taken = [&](const std::string& name) { return taken.contains(name); };
  out.correlation = stated.correlation.renewed(diagnosis.adopted.correlation.part(is_taken), is_taken);
  for (Rotor& rotor : out.rotors) rotor.a_B = axis_at(rotor, slant_angle(out));
  return out;
}

}  // namespace ident
