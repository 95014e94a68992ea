// What an unbalanced blade does beside shaking is not known, and nothing in the catalogue shakes.
#include "ident/gap/verdict/out_of_balance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace ident {

Judged with_vibration(Judged verdict, const Vibration& vibration) {
  if (!vibration.unbalanced()) return verdict;
  const std::string shakes = "Something shakes this vehicle that no cause of the catalogue explains: " +
                             vibration.what_is_unbalanced() + ". Balance the propellers, and fly again.";
  if (verdict.status == "unknown") {
    verdict.sentence = shakes + " " + verdict.sentence;
    return verdict;
  }
  if (!verdict.effects.empty())
    verdict.sentence =
        fmt::format("{} The nearest cause beside that is {}.", shakes, fmt::join(verdict.effects, " with "));
  else
    verdict.sentence = shakes;
  return unnamed(std::move(verdict));
}

}  // namespace ident
