// What no log with that few commands can tell, put in words.
#include "ident/gap/verdict/seldom_input.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace ident {

Judged with_seldom_commands(Judged verdict, double interval) {
  if (verdict.status == "none") return verdict;
  verdict.sentence = fmt::format(
      "No cause can be told from these logs: their commands come at {:.3g} Hz, and what the motors were told "
      "in between passes for a gap. Log commands at 100 Hz or more.",
      1 / interval);
  if (!verdict.effects.empty())
    verdict.sentence += fmt::format(" The nearest cause is {}.", fmt::join(verdict.effects, " with "));
  return unnamed(std::move(verdict));
}

}  // namespace ident
