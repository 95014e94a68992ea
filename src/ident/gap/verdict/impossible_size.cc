// Values of the full fit against null values and limits.
#include "ident/gap/verdict/impossible_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/effects/catalogue.h"

namespace ident {
namespace {

constexpr double kTold = 2.0;  // standard deviations from no such cause

const Parameter* value_of(const std::vector<Parameter>& fitted, const std::string& name) {
  const auto at = std::ranges::find(fitted, name, &Parameter::name);
  return at == fitted.end() ? nullptr : &*at;
}

}  // namespace

std::string impossible_size(const SearchResult& search, const std::vector<Parameter>& fitted) {
  for (const Candidate& cause : search.best.adopted) {
    const EffectEntry* effect = find_effect(cause.name);
    if (!effect) continue;
    const auto own = [&](const EffectParameter& p) {
      return value_of(fitted, cause.name + "." + std::string(p.name));
    };
    if (effect->parameters.size() == 1) {
      const EffectParameter& only = effect->parameters[0];
      if (const Parameter* p = own(only); p && std::abs(p->value - only.null_value) < kTold * p->std)
        return fmt::format("fitted in full nothing is left of {} ({} = {} ± {})", cause.name, only.name,
                           format_number(p->value, 2), format_number(p->std, 2));
    }
    if (cause.name != "payload") continue;
    for (const EffectParameter& p : effect->parameters) {
      const Parameter* at = own(p);
      if (at && p.unit == "m" && std::abs(at->value) > p.limit)
        return fmt::format("the payload would be {} m from the vehicle", format_number(at->value, 2));
    }
  }
  return {};
}

}  // namespace ident
