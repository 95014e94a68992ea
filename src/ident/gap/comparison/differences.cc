// Forward selection over the causes by equation (2), each held against chance over all looks.
#include "ident/gap/comparison/differences.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "ident/core/statistics.h"
#include "ident/effects/cause_traits.h"
#include "ident/gap/verdict/decision.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Set = std::vector<std::size_t>;

// Probability that anything is named where nothing differs, over all looks. [-]
constexpr double kFalseAlarm = 0.01;
// Of its own value by which a constant has to differ. [-] Benches tell less apart.
constexpr double kMaterialConstant = 0.03;
constexpr std::size_t kMostDifferences = 6;
constexpr std::string_view kConstant = "parameter:";

// Fall of the misfit from which one explanation is told and the other one is not.
const double kToldApart = 2 * std::log(1 / kTold);

bool contains(const Set& set, std::size_t k) { return std::ranges::find(set, k) != set.end(); }

// The two constants of the motors' lag are one cause, of which the first in order is the name.
bool are_of_lag(const std::string& a, const std::string& b) {
  return traits_of(a).of_lag && traits_of(b).of_lag;
}

struct Group {
  std::string name;
  std::vector<Index> at;
  bool named;  ///< by a side, and so free of its prior in both fits
};

// What both fits have, in one order.
struct Common {
  std::vector<std::string> names;
  VectorXd real, simulated, d;
  MatrixXd C_real, C_simulated, S, response;
  std::vector<Group> groups;

  double size(Index i) const { return std::max(std::abs(real[i]), std::abs(simulated[i])); }
};

void add_to_groups(std::vector<Group>& groups, const ComparedName& name, Index i) {
  const bool named = !name.cause.empty();
  const std::string cause = named ? name.cause : std::string(kConstant) + name.constant;
  const auto group = std::ranges::find(groups, cause, &Group::name);
  if (group == groups.end())
    groups.push_back({cause, {i}, named});
  else
    group->at.push_back(i);
}

Common common(const ComparedFit& real, const ComparedFit& simulated) {
  std::vector<Index> a, b;
  Common out;
  for (std::size_t i = 0; i < real.names.size(); ++i) {
    const auto there = std::ranges::find(simulated.names, real.names[i].constant, &ComparedName::constant);
    if (there == simulated.names.end()) continue;
    add_to_groups(out.groups, real.names[i], static_cast<Index>(a.size()));
    a.push_back(static_cast<Index>(i)), b.push_back(there - simulated.names.begin());
    out.names.push_back(real.names[i].constant);
  }
  out.real = real.value(a), out.simulated = simulated.value(b);
  out.d = out.real - out.simulated;  // (1)
  out.C_real = real.covariance(a, a), out.C_simulated = simulated.covariance(b, b);
  out.S = out.C_real + out.C_simulated;
  out.response = 0.5 * (real.response(a, a) + simulated.response(b, b));
  return out;
}

ComparedCause compared(const Common& all, const Group& group) {
  ComparedCause out{.name = group.name};
  for (const Index i : group.at)
    out.constants.push_back({.name = all.names[static_cast<std::size_t>(i)],
                             .real = all.real[i],
                             .real_std = std::sqrt(all.C_real(i, i)),
                             .simulated = all.simulated[i],
                             .simulated_std = std::sqrt(all.C_simulated(i, i)),
                             .difference = all.d[i],
                             .std = std::sqrt(all.S(i, i))});
  const VectorXd d = all.d(group.at);
  const double square = d.dot(MatrixXd(all.S(group.at, group.at)).ldlt().solve(d));
  if (std::isfinite(square)) out.p = 1.0 - chi2_cdf(square, static_cast<double>(group.at.size()));
  return out;
}

// Equation (2), divided by the noise: S = L L'.
class Selection {
 public:
  Selection(const Common& all, const ComparisonRules& rules) : all_(all), rules_(rules) {
    const VectorXd scale = all.S.diagonal().cwiseSqrt().cwiseInverse();  // units differ by many decades
    const Eigen::LLT<MatrixXd> llt(scale.asDiagonal() * all.S * scale.asDiagonal());
    if (llt.info() != Eigen::Success) return;
    d_ = llt.matrixL().solve(scale.cwiseProduct(all.d));
    G_ = llt.matrixL().solve(MatrixXd(scale.asDiagonal() * all.response));
    while (set_.size() < kMostDifferences && add_one()) continue;
  }

  const Set& set() const { return set_; }

  bool is_material(std::size_t k, const Set& rest) const {
    const Group& group = all_.groups[k];
    if (!group.name.starts_with(kConstant)) return rules_.material.contains(group.name);
    return std::abs(size_of(k, rest).first) > kMaterialConstant * all_.size(group.at.front());
  }

  // Size and deviation of the first constant of a cause beside others.
  std::pair<double, double> size_of(std::size_t k, const Set& rest) const {
    Set order{k};
    for (const std::size_t other : rest)
      if (other != k) order.push_back(other);
    const MatrixXd G = columns(order),
                   C = (G.transpose() * G).completeOrthogonalDecomposition().pseudoInverse();
    return {(C * (G.transpose() * d_))[0], std::sqrt(C(0, 0))};
  }

  std::vector<std::string> alternatives_to(std::size_t chosen) const {
    Set rest = set_;
    std::erase(rest, chosen);
    const double there = explained(set_);
    std::vector<std::string> out;
    for (std::size_t k = 0; k < all_.groups.size(); ++k) {
      if (contains(set_, k) || !may_be_tried(k) || are_of_lag(name(k), name(chosen))) continue;
      Set other = rest;
      other.push_back(k);
      if (explained(other) > there - kToldApart && is_material(k, rest)) out.push_back(name(k));
    }
    return out;
  }

 private:
  const std::string& name(std::size_t k) const { return all_.groups[k].name; }

  // The other constant of a lag that a side names is no further cause.
  bool may_be_tried(std::size_t k) const {
    if (all_.groups[k].named) return true;
    return rules_.constants && std::ranges::none_of(all_.groups, [&](const Group& g) {
             return g.named && are_of_lag(g.name, name(k));
           });
  }

  MatrixXd columns(const Set& set) const {
    std::vector<Index> at;
    for (const std::size_t k : set) at.insert(at.end(), all_.groups[k].at.begin(), all_.groups[k].at.end());
    return G_(Eigen::all, at);
  }

  double explained(const Set& set) const {
    if (set.empty()) return 0.0;
    const MatrixXd G = columns(set);
    const double gain = d_.dot(G * G.completeOrthogonalDecomposition().solve(d_));
    return std::isfinite(gain) ? gain : 0.0;
  }

  bool is_beyond_chance(std::size_t k, double gain) const {
    const Group& group = all_.groups[k];
    if (!group.named) return gain > kBeyondChance * kBeyondChance;
    const double p = 1.0 - chi2_cdf(gain, static_cast<double>(group.at.size()));
    return p < kFalseAlarm / static_cast<double>(all_.groups.size());
  }

  bool add_one() {
    std::size_t best = all_.groups.size();
    double most = 0;
    for (std::size_t k = 0; k < all_.groups.size(); ++k) {
      if (contains(set_, k) || !may_be_tried(k)) continue;
      Set with = set_;
      with.push_back(k);
      const double gain = explained(with) - explained(set_);
      // What a side names goes before what only takes its place; the first constant of a lag before the
      // other.
      const double bonus = all_.groups[k].named ? kToldApart : 0.0;
      const bool same_lag = best < all_.groups.size() && are_of_lag(name(best), name(k));
      const bool passes = is_beyond_chance(k, gain) && (all_.groups[k].named || is_material(k, set_));
      if (passes && gain + bonus > most + (same_lag ? kToldApart : 0.0)) most = gain + bonus, best = k;
    }
    if (best == all_.groups.size()) return false;
    set_.push_back(best);
    return true;
  }

  const Common& all_;
  const ComparisonRules& rules_;
  VectorXd d_;
  MatrixXd G_;
  Set set_;
};

}  // namespace

std::vector<ComparedCause> differences(const ComparedFit& real, const ComparedFit& simulated,
                                       const ComparisonRules& rules) {
  const Common all = common(real, simulated);
  std::vector<ComparedCause> out;
  for (const Group& group : all.groups) out.push_back(compared(all, group));
  const Selection selection(all, rules);
  for (const std::size_t k : selection.set()) {
    out[k].differs = selection.is_material(k, selection.set());
    if (!out[k].differs) continue;  // it takes its part of d, and is not worth a name
    out[k].alternatives = selection.alternatives_to(k);
    if (all.groups[k].named) continue;
    ComparedConstant& constant = out[k].constants.front();
    std::tie(constant.difference, constant.std) = selection.size_of(k, selection.set());
  }
  return out;
}

}  // namespace ident
