// Probabilities keep the most probable first.
#include "ident/gap/verdict/trust.h"

#include <algorithm>

#include "ident/gap/verdict/verdict.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

// Of 1253 blind cases with a voltage thrust shows the battery plainly in five. It is there in all of them;
// and a lag that no physics makes was wrong wherever it was seen.
constexpr double kPlainlyThere = 0.95;

bool is_one_of(const Json& candidate, const std::vector<std::string>& names) {
  return std::ranges::find(names, candidate["effect"].get<std::string>()) != names.end();
}

void most_probable_first(Json& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(), [](const Json& a, const Json& b) {
    return a["probability"].get<double>() > b["probability"].get<double>();
  });
}

}  // namespace

void trust_less(Json& candidates, const std::vector<std::string>& named) {
  for (Json& c : candidates)
    if (!is_one_of(c, named)) c["probability"] = Judged::kNearestIsThere * c["probability"].get<double>();
  most_probable_first(candidates);
}

void trust_more(Json& candidates, const std::vector<std::string>& plain) {
  for (Json& c : candidates)
    if (is_one_of(c, plain)) c["probability"] = std::max(kPlainlyThere, c["probability"].get<double>());
  most_probable_first(candidates);
}

void doubt_refused(std::vector<Parameter>& parameters, const std::vector<Candidate>& causes) {
  for (Parameter& p : parameters)
    for (const Candidate& c : causes) {
      if (c.name != "parameter:" + p.name && p.name.substr(0, p.name.find('.')) != c.name) continue;
      p.doubt({});
      p.note = "of a cause that is not named";
    }
}

}  // namespace ident
