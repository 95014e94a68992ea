// The gains of all causes beside those found, by the quadratic form.
#include "ident/gap/next_cause.h"

#include <algorithm>

namespace ident {
namespace {

// A cause whose size is beyond what it can have is worth a trial where it gains so many times what any other
// does: a strong one overshoots where the model is bent in its place.
constexpr double kFarMore = 10.0;

}  // namespace

NextCause next_cause(const Standing& at, const std::function<bool(int)>& barred,
                     const std::vector<Candidate>& tried) {
  NextCause out;
  std::vector<Further> passed;
  Further beyond;
  double most = 0;
  for (int c = 0; c < static_cast<int>(at.problem.candidates.size()); ++c) {
    if (std::ranges::find(at.have, c) != at.have.end() || barred(c)) continue;
    const Candidate& cause = at.problem.candidates[static_cast<std::size_t>(c)];
    const Further f = further(at, at.have, c);
    if (f.passes()) passed.push_back(f);
    if (f.possible) most = std::max(most, f.gain);
    if (std::ranges::any_of(tried, [&](const Candidate& t) { return same(t, cause); })) continue;
    if (f.possible && f.gain > out.uneven.gain) out.uneven = f;
    if (f.beyond && f.gain > beyond.gain) beyond = f;
  }
  if (beyond.gain > kFarMore * most) out.uneven = beyond;
  if (passed.empty()) return out;
  const double common = std::ranges::max_element(passed, {}, &Further::gain)->stretch;
  out.best = *std::ranges::max_element(passed, {},
                                       [&](const Further& f) { return 0.5 * f.gain / common - f.price; });
  return out;
}

}  // namespace ident
