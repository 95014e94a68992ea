// Test (2) for causes that a side names, then a forward selection by (3) over the constants of the vehicle.
#include "ident/gap/comparison/differences.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"
#include "ident/gap/verdict/decision.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Probability that anything is named where nothing differs, over all looks. [-]
constexpr double kFalseAlarm = 0.01;
// Of its own value by which a constant differs that no side names. [-] Benches tell less apart.
constexpr double kMaterialConstant = 0.03;
constexpr int kMostConstants = 4;

// What both fits have, in one order.
struct Common {
  std::vector<ComparedName> names;
  VectorXd real, simulated, d;
  MatrixXd C_real, C_simulated, S, response;
  std::vector<std::string> causes;  ///< names, each once; constants of the vehicle as parameter:NAME

  std::string cause(Index i) const {
    const ComparedName& name = names[static_cast<std::size_t>(i)];
    return name.cause.empty() ? "parameter:" + name.constant : name.cause;
  }
  std::vector<Index> constants_of(const std::string& of) const {
    std::vector<Index> out;
    for (Index i = 0; i < d.size(); ++i)
      if (cause(i) == of) out.push_back(i);
    return out;
  }
  bool under_prior(Index i) const { return names[static_cast<std::size_t>(i)].cause.empty(); }
};

Common common(const ComparedFit& real, const ComparedFit& simulated) {
  std::vector<Index> a, b;
  Common out;
  for (std::size_t i = 0; i < real.names.size(); ++i) {
    const auto there = std::ranges::find(simulated.names, real.names[i].constant, &ComparedName::constant);
    if (there == simulated.names.end()) continue;
    a.push_back(static_cast<Index>(i)), b.push_back(there - simulated.names.begin());
    out.names.push_back(real.names[i]);
  }
  out.real = real.value(a), out.simulated = simulated.value(b);
  out.d = out.real - out.simulated;  // (1)
  out.C_real = real.covariance(a, a), out.C_simulated = simulated.covariance(b, b);
  out.S = out.C_real + out.C_simulated;
  out.response = 0.5 * (real.response(a, a) + simulated.response(b, b));
  for (Index i = 0; i < out.d.size(); ++i)
    if (std::ranges::find(out.causes, out.cause(i)) == out.causes.end()) out.causes.push_back(out.cause(i));
  return out;
}

ComparedCause compared(const Common& all, const std::string& cause) {
  ComparedCause out{.name = cause};
  const std::vector<Index> at = all.constants_of(cause);
  for (const Index i : at)
    out.constants.push_back({.name = all.names[static_cast<std::size_t>(i)].constant,
                             .real = all.real[i],
                             .real_std = std::sqrt(all.C_real(i, i)),
                             .simulated = all.simulated[i],
                             .simulated_std = std::sqrt(all.C_simulated(i, i)),
                             .difference = all.d[i],
                             .std = std::sqrt(all.S(i, i))});
  const VectorXd d = all.d(at);
  const double square = d.dot(MatrixXd(all.S(at, at)).ldlt().solve(d));  // (2)
  if (std::isfinite(square)) out.p = 1.0 - chi2_cdf(square, static_cast<double>(at.size()));
  return out;
}

// Equation (3) over the rows that no named difference explains.
class Selection {
 public:
  Selection(const Common& all, const std::vector<Index>& rows) {
    // Scaled by their deviations: units differ by many orders of magnitude.
    const VectorXd scale = all.S.diagonal()(rows).cwiseSqrt();
    MatrixXd S =
        scale.cwiseInverse().asDiagonal() * MatrixXd(all.S(rows, rows)) * scale.cwiseInverse().asDiagonal();
    const Eigen::LLT<MatrixXd> llt(S);
    valid_ = llt.info() == Eigen::Success;
    if (!valid_) return;
    d_ = llt.matrixL().solve(VectorXd(all.d(rows).cwiseQuotient(scale)));
    for (const Index i : rows) {
      if (!all.under_prior(i)) continue;
      places_.push_back(i);
      columns_.push_back(llt.matrixL().solve(VectorXd(all.response.col(i)(rows).cwiseQuotient(scale))));
    }
  }

  bool valid() const { return valid_; }
  std::size_t size() const { return places_.size(); }
  Index place(std::size_t k) const { return places_[k]; }

  // What a set explains of d' S^-1 d.
  double explained(const std::vector<std::size_t>& set) const {
    if (set.empty()) return 0.0;
    const MatrixXd G = matrix(set);
    const double gain = d_.dot(G * G.colPivHouseholderQr().solve(d_));
    return std::isfinite(gain) ? gain : 0.0;
  }
  // Size and deviation of the last one of a set.
  std::pair<double, double> last(const std::vector<std::size_t>& set) const {
    const MatrixXd G = matrix(set);
    const MatrixXd C = (G.transpose() * G).inverse();
    const VectorXd delta = C * (G.transpose() * d_);
    return {delta.tail<1>()[0], std::sqrt(C.bottomRightCorner<1, 1>()(0, 0))};
  }

 private:
  MatrixXd matrix(const std::vector<std::size_t>& set) const {
    MatrixXd G(d_.size(), static_cast<Index>(set.size()));
    for (std::size_t k = 0; k < set.size(); ++k) G.col(static_cast<Index>(k)) = columns_[set[k]];
    return G;
  }

  bool valid_ = false;
  VectorXd d_;
  std::vector<Index> places_;
  std::vector<VectorXd> columns_;
};

// Whether the last one of a set differs by more than a small part of itself.
bool is_material(const Selection& selection, const Common& all, const std::vector<std::size_t>& set) {
  const Index i = selection.place(set.back());
  const double size = std::max(std::abs(all.real[i]), std::abs(all.simulated[i]));
  return std::abs(selection.last(set).first) > kMaterialConstant * size;
}

// The constant that explains most beside a set; size() where none does beyond chance.
std::size_t next(const Selection& selection, const Common& all, const std::vector<std::size_t>& set) {
  std::size_t best = selection.size();
  double most = kBeyondChance * kBeyondChance;
  for (std::size_t k = 0; k < selection.size(); ++k) {
    std::vector<std::size_t> with = set;
    with.push_back(k);
    const double gain = selection.explained(with) - selection.explained(set);
    if (std::ranges::find(set, k) == set.end() && gain > most && is_material(selection, all, with))
      most = gain, best = k;
  }
  return best;
}

std::vector<std::string> alternatives_to(std::size_t chosen, const std::vector<std::size_t>& set,
                                         const Selection& selection, const Common& all) {
  const double told = 2 * std::log(1 / kTold), there = selection.explained(set);
  std::vector<std::size_t> rest = set;
  std::erase(rest, chosen);
  std::vector<std::string> out;
  for (std::size_t k = 0; k < selection.size(); ++k) {
    if (std::ranges::find(set, k) != set.end()) continue;
    std::vector<std::size_t> other = rest;
    other.push_back(k);
    if (selection.explained(other) > there - told && is_material(selection, all, other))
      out.push_back(all.cause(selection.place(k)));
  }
  return out;
}

void select_constants(const Common& all, const std::vector<Index>& rows, std::vector<ComparedCause>& causes) {
  const Selection selection(all, rows);
  if (!selection.valid()) return;
  std::vector<std::size_t> set;
  while (static_cast<int>(set.size()) < kMostConstants) {
    const std::size_t k = next(selection, all, set);
    if (k == selection.size()) break;
    set.push_back(k);
  }
  for (const std::size_t k : set) {
    std::vector<std::size_t> order = set;
    std::erase(order, k);
    const double gain = selection.explained(set) - selection.explained(order);
    order.push_back(k);
    ComparedCause& cause = *std::ranges::find(causes, all.cause(selection.place(k)), &ComparedCause::name);
    cause.differs = true;
    cause.p = 1.0 - chi2_cdf(gain, 1.0);
    std::tie(cause.constants[0].difference, cause.constants[0].std) = selection.last(order);
    cause.alternatives = alternatives_to(k, set, selection, all);
  }
}

}  // namespace

std::vector<ComparedCause> differences(const ComparedFit& real, const ComparedFit& simulated,
                                       const std::set<std::string>& named) {
  const Common all = common(real, simulated);
  std::vector<ComparedCause> out;
  std::vector<Index> rows;  // that no named difference explains
  for (const std::string& cause : all.causes) {
    out.push_back(compared(all, cause));
    const std::vector<Index> at = all.constants_of(cause);
    if (all.under_prior(at.front())) {
      rows.push_back(at.front());
      continue;
    }
    out.back().differs =
        named.contains(cause) && out.back().p < kFalseAlarm / static_cast<double>(all.causes.size());
    if (!out.back().differs) rows.insert(rows.end(), at.begin(), at.end());
  }
  select_constants(all, rows, out);
  return out;
}

}  // namespace ident
