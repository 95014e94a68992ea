// Names the constants that a fit does not determine, with the combinations that it does.
#include "ident/flight/checks/unidentifiable.h"

#include <string>
#include <vector>

#include "ident/flight/checks/implausible_estimates.h"
#include "ident/flight/fit/fitted_parameters.h"

namespace ident {

void warn_about(Result& result, const Theta& theta, const FlightFit& fit) {
  warn_of_disagreement(result, "the model lacks an effect (try ident gap)");
  doubt_negative_dead_time(result);
  doubt_drawn_away(result);
  std::string unknown;
  for (const Parameter& p : result.parameters)
    if (!p.identifiable) unknown += (unknown.empty() ? "" : ", ") + p.name;
  if (!unknown.empty()) {
    std::string text = "these logs do not determine " + unknown;
    std::vector<std::string> pairs;
    if (!result.has_warning("thrust_level")) pairs = combinations(theta, fit, result.parameters);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      text += (i == 0 ? "; what they do determine: " : ", ") + pairs[i];
    result.warn("not_identifiable", text);
  }
}

}  // namespace ident
