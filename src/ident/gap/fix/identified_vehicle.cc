// Takes over identified constants with their correlations.
#include "ident/gap/fix/identified_vehicle.h"

#include <set>

namespace ident {

Vehicle identified_vehicle(const Vehicle& stated, const Diagnosis& diagnosis) {
  Vehicle out = stated;
  std::set<std::string> taken;
  for (const auto& [name, known] : diagnosis.adopted.parameters) {
    const Parameter* found = diagnosis.result.find(name);
    if (!found || !(found->identifiable || found->joint)) continue;
    out.parameters[name] = known;
    taken.insert(name);
  }
  const auto is_taken = [&](const std::string& name) { return taken.contains(name); };
  out.correlation = stated.correlation.renewed(diagnosis.adopted.correlation.part(is_taken), is_taken);
  for (Rotor& rotor : out.rotors) rotor.a_B = axis_at(rotor, slant_angle(out));
  return out;
}

}  // namespace ident
