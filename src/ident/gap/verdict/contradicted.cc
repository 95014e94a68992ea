// Pulls of fitted constants against what was stated of them.
#include "ident/gap/verdict/contradicted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/effects/cause_traits.h"
#include "ident/gap/verdict/decision.h"

namespace ident {

std::vector<Contradiction> contradictions(const std::vector<Parameter>& fitted,
                                          const std::vector<std::string>& causes) {
  constexpr double kOff = 2.0;  // of the bench's own deviations
  const auto is_cause = [&](const Parameter& p) {
    const std::string own = "parameter:" + p.name;
    return std::ranges::any_of(causes, [&](const std::string& cause) {
      return cause == own || (traits_of(cause).of_lag && traits_of(own).of_lag);
    });
  };
  std::vector<Contradiction> out;
  for (const Parameter& p : fitted) {
    const bool heard = p.known_together || (p.from_flight && *p.from_flight > kHeard);
    if (!p.pull || !p.prior_value || !heard || is_cause(p)) continue;
    const bool off =
        p.known_together || std::abs(p.value - *p.prior_value) > kOff * p.prior_std.value_or(1e300);
    if (!off || !(std::abs(*p.pull) > kBeyondChance)) continue;
    out.push_back({p.name, p.unit, *p.prior_value, p.value, p.std, std::abs(*p.pull)});
  }
  std::ranges::sort(out, std::greater<>(), &Contradiction::deviations);
  return out;
}

std::string in_words(const Contradiction& one) {
  return fmt::format("{} is {}{}, not {} as stated ({:.0f} standard deviations)", one.constant,
                     format_with_uncertainty(one.found, one.std),
                     one.unit.empty() || one.unit == "-" ? "" : " " + one.unit, format_number(one.stated, 4),
                     one.deviations);
}

}  // namespace ident
