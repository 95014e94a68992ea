// Takes back causes of single rotors, and says what shakes.
#include "ident/gap/verdict/out_of_balance.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "ident/effects/cause_traits.h"
#include "ident/gap/verdict/decision.h"

namespace ident {

Judged with_vibration(Judged verdict, const Vibration& vibration) {
  if (!vibration.unbalanced()) return verdict;
  const std::string shakes = "Something shakes this vehicle that no cause of the catalogue explains: " +
                             vibration.what_is_unbalanced() + ". Balance the propellers, and fly again.";
  verdict.rest.signs.insert(verdict.rest.signs.begin(), {std::log(1e4), vibration.what_is_unbalanced()});
  verdict.rest.probability = std::max(verdict.rest.probability, kClaimed);
  verdict.sentence = shakes + (verdict.status == "none" ? "" : " " + verdict.sentence);
  std::vector<std::string> of_rotors;
  std::ranges::copy_if(verdict.effects, std::back_inserter(of_rotors),
                       [](const std::string& name) { return traits_of(name).per_rotor; });
  return unnamed(std::move(verdict), of_rotors);
}

}  // namespace ident
