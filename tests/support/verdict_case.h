// What a search found, made by hand, and the verdict on it.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "ident/gap/verdict/verdict.h"

namespace ident {

// What a search found, all else as it is where a cause explains everything.
struct VerdictCase {
  SearchResult search;
  GapClosed gap;
  Rival rival;
  std::vector<SpectralLine> lines;
  std::vector<Burst> jumps;
  std::vector<Unsteady> unsteady;
  std::vector<Parameter> fitted;
  GapShares shares;

  VerdictCase(const std::vector<std::string>& candidates, const std::vector<std::string>& found) {
    for (const std::string& name : candidates) search.problem.candidates.push_back({name});
    for (const std::string& name : found) {
      search.best.adopted.push_back({name});
      search.alone.push_back({name, 1000.0});
    }
    closes({0.9, 1.0}, 0.97);
  }
  /// So much of what was ten times the floor.
  void closes(std::array<double, 2> ci95, double closed) {
    gap = {closed, ci95, 10.0, std::sqrt(1.0 + (1 - closed) * 99.0), 1.0};
    shares = {10.0, {}, {1 - closed, {1 - ci95[1], 1 - ci95[0]}}};
    const std::vector<std::string> names = names_of(search.best.adopted);
    for (const std::string& name : names) {
      const double part = 1.0 / static_cast<double>(names.size());
      shares.causes.push_back({name, {part * closed, {part * ci95[0], part * ci95[1]}}});
    }
  }
  void weighs(const std::vector<int>& members, double probability) {
    search.sets.push_back({members, 0.0, probability});
  }
  /// kT: the flight says 1.3 where the bench said 1.0 +- 0.05.
  void contradicts_kT(double deviations) {
    Parameter kT;
    kT.name = "kT", kT.value = 1.3, kT.prior_value = 1.0, kT.prior_std = 0.05;
    kT.pull = deviations, kT.from_flight = 0.9;
    fitted = {kT};
  }
  bool by_side = false;  ///< shares are of the side on which the cause acts
  Judged judged() const {
    return judge({search, gap, shares, rival, lines, jumps, unsteady, fitted, by_side});
  }
};

}  // namespace ident
