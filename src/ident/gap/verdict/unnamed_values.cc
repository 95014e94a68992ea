// By the names of constants: those of an effect begin with its name.
#include "ident/gap/verdict/unnamed_values.h"

#include <algorithm>

#include "ident/effects/cause_traits.h"

namespace ident {

void doubt_unnamed(std::vector<Parameter>& parameters, const std::vector<Candidate>& causes,
                   const std::vector<std::string>& named) {
  for (Parameter& p : parameters)
    for (const Candidate& c : causes) {
      const bool own = c.name == "parameter:" + p.name || p.name.substr(0, p.name.find('.')) == c.name;
      const bool brought = std::ranges::any_of(named, [&](const auto& n) { return implies(n, c.name); });
      if (!own || brought || std::ranges::find(named, c.name) != named.end()) continue;
      p.doubt({});
      p.note = "of a cause that is not named";
    }
}

}  // namespace ident
