// The table of requirements: one row each, one column for each contestant.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "score_tables.h"
#include "tally.h"

namespace withheld {

namespace {

using Cases = std::vector<Scored>;
using Predicate = std::function<bool(const Truth&)>;

Share share_of(const Cases& cases, const Predicate& asked, const std::function<bool(Outcome)>& hit) {
  Share share;
  for (const Scored& c : cases) {
    if (asked(c.truth)) share.count(hit(outcome_of(c.truth, c.answer)));
  }
  return share;
}

Share excluded_share(const Cases& cases, const Predicate& asked, Outcome wanted) {
  Share share;
  for (const Scored& c : cases) {
    if (!asked(c.truth)) continue;
    if (c.truth.outside)
      share.count(outcome_without_truth(c.answer) == wanted);
    else if (c.excluded)
      share.count(outcome_without_truth(*c.excluded) == wanted);
  }
  return share;
}

bool single_above_3(const Truth& t) { return t.kind == "single" && size_of(t) >= 3; }
bool pair_above_3(const Truth& t) { return t.kind == "pair" && size_of(t) >= 3; }
bool joint_pair_above_3(const Truth& t) {
  return t.kind == "pair" && std::min(t.effects[0].over_limit_joint, t.effects[1].over_limit_joint) >= 3;
}
bool withheld_above_5(const Truth& t) { return t.kind != "none" && size_of(t) >= 5; }
bool alone_above_5(const Truth& t) {
  return withheld_above_5(t) && t.kind != "pair" && t.left_by_look_alike >= 3;
}

std::string number(double value, const char* format) {
  if (std::isnan(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string median_closed(const Cases& cases) {
  std::vector<double> closed;
  for (const Scored& c : cases) {
    const Outcome outcome = outcome_of(c.truth, c.answer);
    if (size_of(c.truth) >= 3 && outcome == Outcome::right && c.answer.closed)
      closed.push_back(*c.answer.closed);
  }
  return number(100 * median(closed), "%.0f %%") + " (" + std::to_string(closed.size()) + ")";
}

std::string worst_decile(const Cases& cases) {
  double worst = std::nan("");
  for (const Reliability& decile : reliability(cases)) {
    if (decile.count < 20) continue;
    const double off = std::abs(decile.stated - decile.truly) / decile.count;
    worst = std::isnan(worst) ? off : std::max(worst, off);
  }
  return number(worst, "%.2f");
}

std::string seconds(const Cases& cases) {
  std::vector<double> all;
  for (const Scored& c : cases) {
    if (c.answer.seconds > 0) all.push_back(c.answer.seconds);
  }
  const double most = all.empty() ? std::nan("") : *std::max_element(all.begin(), all.end());
  return number(median(all), "%.2f s") + ", " + number(most, "%.2f s");
}

std::string cases_of(const Cases& cases) {
  std::string text;
  for (const char* kind : {"none", "single", "pair", "outside"}) {
    const auto count =
        std::count_if(cases.begin(), cases.end(), [&](const Scored& c) { return c.truth.kind == kind; });
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  }
  return text;
}

}  // namespace

void print_summary(const std::vector<Contestant>& contestants, std::ostream& out) {
  const auto row = [&](const std::string& asked, const std::string& target,
                       const std::function<std::string(const Cases&)>& value) {
    out << "| " << asked << " | " << target << " |";
    for (const Contestant& c : contestants) out << ' ' << value(c.cases) << " |";
    out << '\n';
  };
  const auto is = [](Outcome wanted) { return [wanted](Outcome o) { return o == wanted; }; };
  out << "| what | asked |";
  for (const Contestant& c : contestants) out << ' ' << c.label << " |";
  out << "\n|---|---|";
  for (std::size_t i = 0; i < contestants.size(); ++i) out << "---|";
  out << '\n';
  row("cases", "400, 100 none, 60 outside", cases_of);
  row("single, 3 x limit or more: right or in a group of at most 3", "95 %", [&](const Cases& c) {
    return share_of(c, single_above_3, [](Outcome o) { return o == Outcome::right || o == Outcome::group; })
        .text();
  });
  row("of these singled out", "85 %",
      [&](const Cases& c) { return share_of(c, single_above_3, is(Outcome::right)).text(); });
  row("pairs, both 3 x limit or more: both named", "75 %",
      [&](const Cases& c) { return share_of(c, pair_above_3, is(Outcome::right)).text(); });
  row("the same, or in a group of at most 3", "", [&](const Cases& c) {
    return share_of(c, pair_above_3, [](Outcome o) { return o == Outcome::right || o == Outcome::group; })
        .text();
  });
  row("both named, each 3 x limit with the other free", "",
      [&](const Cases& c) { return share_of(c, joint_pair_above_3, is(Outcome::right)).text(); });
  row("no effect: a cause is named", "at most 2 %", [](const Cases& c) {
    return share_of(
               c, [](const Truth& t) { return t.kind == "none"; },
               [](Outcome o) { return o == Outcome::wrong || o == Outcome::wide; })
        .text();
  });
  row("no effect: unknown gap claimed", "", [&](const Cases& c) {
    return share_of(
               c, [](const Truth& t) { return t.kind == "none"; }, is(Outcome::unknown))
        .text();
  });
  row("truth taken out or outside, 5 x: unknown", "85 %",
      [](const Cases& c) { return excluded_share(c, withheld_above_5, Outcome::unknown).text(); });
  row("the same: confident wrong name", "at most 5 %",
      [](const Cases& c) { return excluded_share(c, withheld_above_5, Outcome::wrong).text(); });
  row("5 x, and no other effect leaves less than 3 x: unknown", "",
      [](const Cases& c) { return excluded_share(c, alone_above_5, Outcome::unknown).text(); });
  row("the same: confident wrong name", "",
      [](const Cases& c) { return excluded_share(c, alone_above_5, Outcome::wrong).text(); });
  row("worst decile of 20 or more: stated against true", "0.1", worst_decile);
  row("parameters within 2 std, same equation", "85 %",
      [](const Cases& c) { return recovery(c, "exact").text(); });
  row("parameters within 2 std, same to first order", "",
      [](const Cases& c) { return recovery(c, "near").text(); });
  row("gap closed by the right cause, median", "90 %", median_closed);
  row("run time, median and longest", "3 s", seconds);
  row("no answer", "0", [&](const Cases& c) {
    return share_of(
               c, [](const Truth&) { return true; }, is(Outcome::failed))
        .text();
  });
}

}  // namespace withheld
