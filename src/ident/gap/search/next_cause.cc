// The gains of all causes beside those found, by the quadratic form.
#include "ident/gap/search/next_cause.h"

#include <algorithm>
#include <cmath>

namespace ident {
namespace {

// A cause whose size is beyond what it can have is worth a trial where it gains so many times what any other
// does: a strong one overshoots where the model is bent in its place.
constexpr double kFarMore = 10.0;

// The third and further causes have to explain this share of what was found.
constexpr int kFew = 2;
constexpr double kMaterial = 0.04;
// A second one that changes from one part of the flight to the next explains at least this.
constexpr double kUneven = 5.0;
constexpr double kNextToNothing = 0.01;
// And any but how a sensor is mounted, or a bench value that is wrong by the same everywhere, at least this,
// in units of the noise, and this many roots of what was found: of 27 below, in three blind campaigns, 22
// were the form of the first; above, 15 of 136.
constexpr double kLittle = 50.0;
constexpr double kOfRoot = 0.25;
// A bench value that is wrong by the same in all parts of the flight, and gains so much.
constexpr double kEven = 1.5;
constexpr double kPlainlyWrong = 100.0;

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

// What a second one that changes from one part of the flight to the next gains beside a strong one is that
// one's form; but two that move masses may be one payload. A bench value that is wrong by the same everywhere
// is no form of anything.
bool is_material(const Further& next, const Candidate& cause, int found, double explained) {
  const double gain = next.honest();
  const bool even = cause.parameter >= 0 && next.stretch < kEven;
  if (found >= kFew) return (even && gain > kPlainlyWrong) || gain >= kMaterial * explained;
  if (!even && !is_of_mounting(cause.name) && found > 0 &&
      gain < std::max(kLittle, kOfRoot * std::sqrt(explained)))
    return false;
  return moves_mass(cause) || next.stretch < kUneven || gain >= kNextToNothing * explained;
}

}  // namespace ident
