// Takes over identified constants with their correlations.
#include "ident/gap/fix/identified_vehicle.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace ident {
namespace {

// Share of what is known of a constant that the flights must have told. [-] As for a contradiction.
constexpr double kHeard = 0.05;

bool is_identified(const Parameter& p) { return p.identifiable || p.joint; }

bool is_named(const std::string& effect, const Result& result) {
  if (!result.extra.contains("verdict")) return false;
  return std::ranges::any_of(result.extra["verdict"]["effects"],
                             [&](const auto& name) { return name == effect; });
}

// A drag known with the rotor speed only is not identified by itself, and is there.
bool is_told(const Parameter& p, const Result& result) {
  if (is_identified(p)) return true;
  const std::size_t dot = p.name.find('.');
  if (dot != std::string::npos) return std::isfinite(p.value) && is_named(p.name.substr(0, dot), result);
  return p.prior_value && p.from_flight.value_or(0.0) > kHeard;
}

}  // namespace

Vehicle identified_vehicle(const Vehicle& stated, const Diagnosis& diagnosis) {
  Vehicle out = stated;
  if (std::ranges::none_of(diagnosis.result.parameters, is_identified)) return out;
  std::set<std::string> taken;
  for (const auto& [name, known] : diagnosis.adopted.parameters) {
    const Parameter* found = diagnosis.result.find(name);
    if (!found || !is_told(*found, diagnosis.result)) continue;
    out.parameters[name] = known;
    taken.insert(name);
  }
  const auto is_taken = [&](const std::string& name) { return taken.contains(name); };
  out.correlation = stated.correlation.renewed(diagnosis.adopted.correlation.part(is_taken), is_taken);
  for (Rotor& rotor : out.rotors) rotor.a_B = axis_at(rotor, slant_angle(out));
  return out;
}

}  // namespace ident
