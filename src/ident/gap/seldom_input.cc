// What no log with that few commands can tell, put in words.
#include "ident/gap/seldom_input.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ident {

Judged with_seldom_commands(Judged verdict, double interval) {
  if (verdict.status == "none") return verdict;
  verdict.sentence = fmt::format(
      "No cause can be told from these logs: their commands come at {:.3g} Hz, and what the motors were told "
      "in between passes for a gap. Log commands at 100 Hz or more.",
      1 / interval);
  if (!verdict.effects.empty())
    verdict.sentence += fmt::format(" The nearest cause is {}.", fmt::join(verdict.effects, " with "));
  verdict.confused_with.insert(verdict.confused_with.begin(), verdict.effects.begin(), verdict.effects.end());
  verdict.refused = !verdict.effects.empty();
  verdict.effects.clear();
  verdict.status = "unknown";
  return verdict;
}

}  // namespace ident
