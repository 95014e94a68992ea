// Gains of sets of causes, and deviations of their sizes, by linear algebra.
#include "ident/gap/hypotheses/screen.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The price of a direction is half the log of the odds between the sizes that it might have had, some times
// its typical one, and those that the data leave; at most that of an effective sample.
constexpr double kPricePerDirection = 2.5;
constexpr double kPlausible = 9.0;  // square of the largest plausible size over the typical one

PriorTerms dropped(const PriorTerms& prior, int i) {
  return prior.loosened(i, std::max(kDropped, std::abs(prior.slope[i])));
}

// The part of an information matrix over the unknowns `free`, factored at a unit diagonal.
class Part {
 public:
  Part(const MatrixXd& H, const std::vector<int>& free) {
    const auto m = static_cast<Eigen::Index>(free.size());
    MatrixXd M(m, m);
    for (Eigen::Index a = 0; a < m; ++a)
      for (Eigen::Index b = 0; b < m; ++b)
        M(a, b) = H(free[static_cast<std::size_t>(a)], free[static_cast<std::size_t>(b)]);
    scale_ = M.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    MatrixXd scaled = scale_.asDiagonal() * M * scale_.asDiagonal();
    scaled.diagonal().array() += 1e-10;
    solver_.compute(scaled);
  }

  VectorXd solve(const VectorXd& r) const {
    return scale_.asDiagonal() * solver_.solve(scale_.asDiagonal() * r);
  }
  double variance(Eigen::Index a) const {
    return solver_.solve(VectorXd::Unit(scale_.size(), a))[a] * scale_[a] * scale_[a];
  }

 private:
  VectorXd scale_;
  Eigen::LLT<MatrixXd> solver_;
};

struct Solved {
  double drop = 0.0;
  VectorXd step;
  double price = 0.0;
};

using Held = std::vector<std::pair<int, double>>;  // unknowns and where they stay

// Minimum over the unknowns `free`, those of `held` there, the rest at zero. The price is that of the last
// `priced` of `free`.
Solved minimum(const QuadraticForm& f, const std::vector<int>& free, const Held& held,
               const std::vector<int>& without_prior, Eigen::Index priced = 0) {
  PriorTerms prior = f.prior;
  for (const int i : without_prior) prior = dropped(prior, i);
  const double waived = f.prior.cost() - prior.cost();  // where the form stands
  const MatrixXd H = f.S + prior.information();
  const VectorXd g = f.g + prior.gradient();
  VectorXd d = VectorXd::Zero(g.size());
  for (const auto& [i, x] : held) d[i] = x;
  const VectorXd Hd = H * d;
  const auto m = static_cast<Eigen::Index>(free.size());
  VectorXd r(m);
  for (Eigen::Index a = 0; a < m; ++a) {
    const int i = free[static_cast<std::size_t>(a)];
    r[a] = g[i] + Hd[i];
  }
  const Part part(H, free);
  const VectorXd x = -part.solve(r);
  Solved out;
  for (Eigen::Index a = m - priced; a < m; ++a)
    out.price += std::min(kPricePerDirection, 0.5 * std::log1p(kPlausible / part.variance(a)));
  for (Eigen::Index a = 0; a < m; ++a) d[free[static_cast<std::size_t>(a)]] = x[a];
  out.step = d;
  out.drop = waived - (2 * g.dot(d) + d.dot(H * d));
  return out;
}

// Least of the first direction of a candidate with a physical sign. A payload hangs within reach, so the
// centre of gravity that it moves says how heavy it is at least; by its shift in the plane of the rotors,
// which flight tells well.
double least_of(const Candidate& candidate, const ExtendedProblem& problem, const VectorXd& step) {
  if (candidate.mass_for_shift == 0) return 0.0;
  const auto scale = [&](std::size_t k) {
    return problem.constants[static_cast<std::size_t>(candidate.directions[k])].scale;
  };
  const double shift =
      std::hypot(scale(1) * step[candidate.directions[1]], scale(2) * step[candidate.directions[2]]);
  return candidate.mass_for_shift * shift / scale(0);
}

// The minimum with a set of causes in the model, and what holds their sizes to what physics allows.
class SetMinimum {
 public:
  SetMinimum(const QuadraticForm& form, const ExtendedProblem& problem, const std::vector<int>& members)
      : form_(form), problem_(problem), free_(base_unknowns(form, problem)) {
    base_ = free_.size();
    std::vector<bool> on(static_cast<std::size_t>(form.constants), false);
    for (const int c : members) {
      const Candidate& candidate = problem.candidates[static_cast<std::size_t>(c)];
      if (candidate.parameter >= 0) dropped_.push_back(candidate.parameter);
      for (const int i : candidate.directions) {
        if (on[static_cast<std::size_t>(i)]) continue;
        on[static_cast<std::size_t>(i)] = true;
        free_.push_back(i);
      }
    }
    degrees_ = static_cast<double>(dropped_.size() + free_.size() - base_);
    // Adopted effects that are not members go back to their null values.
    for (int i = 0; i < form.constants; ++i)
      if (form.null[i] != 0 && !on[static_cast<std::size_t>(i)]) held_.emplace_back(i, form.null[i]);
    solve();
  }

  const Solved& found() const { return found_; }
  double degrees() const { return degrees_; }
  double price() const { return found_.price + kPricePerDirection * static_cast<double>(dropped_.size()); }

  /// Whether the sign is as it must be. A payload too light to be weighed stays at its bound: its place may
  /// still show.
  bool keep_sign(const Candidate& candidate) {
    if (!candidate.positive || candidate.directions.empty()) return true;
    const int i = candidate.directions[0];
    const double least = least_of(candidate, problem_, found_.step - form_.null);
    if (found_.step[i] - form_.null[i] >= least) return true;
    if (candidate.directions.size() == 1) return false;
    const double price = found_.price;
    hold(i, form_.null[i] + least);
    found_.price = std::max(found_.price, price - kPricePerDirection);
    return true;
  }

  /// A height beyond what can be is none.
  void keep_height(const Candidate& candidate) {
    const int i = candidate.height;
    if (i < 0 || std::ranges::find(free_, i) == free_.end()) return;
    const double carried =
        candidate.mass_for_shift > 0 ? size(candidate.directions[0]) / candidate.mass_for_shift : 0.0;
    if (size(i) <= candidate.highest + carried) return;
    hold(i, form_.null[i]);
    degrees_ -= 1;
  }

  bool possible(const Candidate& candidate) const {
    return std::ranges::none_of(candidate.directions, [&](int i) {
      return size(i) > kFarther * physical_limit(problem_.constants[static_cast<std::size_t>(i)]);
    });
  }

 private:
  double size(int i) const {
    return std::abs(problem_.constants[static_cast<std::size_t>(i)].unit() *
                    (found_.step[i] - form_.null[i]));
  }
  void hold(int i, double at) {
    held_.emplace_back(i, at);
    std::erase(free_, i);
    solve();
  }
  void solve() {
    found_ = minimum(form_, free_, held_, dropped_, static_cast<Eigen::Index>(free_.size() - base_));
  }

  const QuadraticForm& form_;
  const ExtendedProblem& problem_;
  std::vector<int> free_, dropped_;
  std::size_t base_ = 0;
  Held held_;
  double degrees_ = 0.0;
  Solved found_;
};

// The cost of a model with no cause in it, adopted effects taken back.
Solved without_causes(const QuadraticForm& form, const ExtendedProblem& problem) {
  Held off;
  for (int i = 0; i < form.constants; ++i)
    if (form.null[i] != 0) off.emplace_back(i, form.null[i]);
  return minimum(form, base_unknowns(form, problem), off, {});
}

}  // namespace

SetGain gain_of(const QuadraticForm& form, const ExtendedProblem& problem, const std::vector<int>& members) {
  const auto candidate = [&](int c) -> const Candidate& {
    return problem.candidates[static_cast<std::size_t>(c)];
  };
  SetMinimum with(form, problem, members);
  SetGain out{.members = members};
  for (const int c : members) out.signs = with.keep_sign(candidate(c)) && out.signs;
  for (const int c : members) with.keep_height(candidate(c));
  out.sizes = std::ranges::all_of(members, [&](int c) { return with.possible(candidate(c)); });
  out.degrees = with.degrees();
  out.gain = with.found().drop - without_causes(form, problem).drop;
  out.step = with.found().step;
  out.price = with.price();
  return out;
}

double deviation_of(const QuadraticForm& form, const ExtendedProblem& problem, int candidate, int direction) {
  const Candidate& c = problem.candidates[static_cast<std::size_t>(candidate)];
  const bool parameter = c.parameter >= 0;
  const int target = parameter ? c.parameter : c.directions[static_cast<std::size_t>(direction)];
  std::vector<int> free = base_unknowns(form, problem);
  if (!parameter) free.push_back(target);
  const PriorTerms prior = parameter ? dropped(form.prior, c.parameter) : form.prior;
  const auto at = std::ranges::find(free, target) - free.begin();
  // What is stated of a parameter may be off by its own deviation as well.
  const double stated =
      parameter && form.prior.slope[target] > 0 ? 1 / std::pow(form.prior.slope[target], 2) : 0.0;
  const double v = Part(form.S + prior.information(), free).variance(at) + stated;
  return std::sqrt(std::max(v, 0.0) * stretch_of(form, parameter ? std::vector<int>{target} : c.directions)) *
         std::abs(problem.constants[static_cast<std::size_t>(target)].unit());
}

}  // namespace ident
