// The quadratic form over all causes, and gains of sets of them by linear algebra.
#include "ident/gap/screen.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What the quadratic form says of a size is that far off at most.
constexpr double kFarther = 3.0;
// The price of a direction is half the log of the odds between the sizes that it might have had, some times
// its typical one, and those that the data leave; at most that of an effective sample.
constexpr double kPricePerDirection = 2.5;
constexpr double kDropped = 100.0;  // times its deviation, a prior counts as dropped
constexpr double kPlausible = 9.0;  // square of the largest plausible size over the typical one

struct Solved {
  double drop = 0.0;
  VectorXd step;
  double price = 0.0;
};

// Minimum over the unknowns `free`, those in `fixed` (index, value) held there, the rest at zero.
// The price is that of the last `priced` of `free`.
Solved minimum(const QuadraticForm& f, const std::vector<int>& free,
               const std::vector<std::pair<int, double>>& fixed, const std::vector<int>& without_prior,
               Eigen::Index priced = 0) {
  const Eigen::Index n = f.g.size();
  PriorTerms prior = f.prior;
  for (const int i : without_prior) prior = prior.loosened(i, kDropped);
  const double waived = f.prior.cost() - prior.cost();  // where the form stands
  const MatrixXd H = f.S + prior.information();
  const VectorXd g = f.g + prior.gradient();
  VectorXd d = VectorXd::Zero(n);
  for (const auto& [i, x] : fixed) d[i] = x;
  const VectorXd Hd = H * d;
  const auto m = static_cast<Eigen::Index>(free.size());
  MatrixXd M(m, m);
  VectorXd r(m);
  for (Eigen::Index a = 0; a < m; ++a) {
    const int i = free[static_cast<std::size_t>(a)];
    r[a] = g[i] + Hd[i];
    for (Eigen::Index b = 0; b < m; ++b) M(a, b) = H(i, free[static_cast<std::size_t>(b)]);
  }
  const VectorXd s = M.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = s.asDiagonal() * M * s.asDiagonal();
  scaled.diagonal().array() += 1e-10;
  const Eigen::LLT<MatrixXd> solver(scaled);
  const VectorXd x = -(s.asDiagonal() * solver.solve(s.asDiagonal() * r));
  Solved out;
  for (Eigen::Index a = m - priced; a < m; ++a) {
    const double variance = solver.solve(VectorXd::Unit(m, a))[a] * s[a] * s[a];
    out.price += std::min(kPricePerDirection, 0.5 * std::log1p(kPlausible / variance));
  }
  for (Eigen::Index a = 0; a < m; ++a) d[free[static_cast<std::size_t>(a)]] = x[a];
  out.step = d;
  out.drop = waived - (2 * g.dot(d) + d.dot(H * d));
  return out;
}

std::vector<int> base_unknowns(const QuadraticForm& f, const ExtendedProblem& problem) {
  std::vector<int> free;
  for (int i = 0; i < problem.base; ++i)
    if (!problem.constants[static_cast<std::size_t>(i)].adopted) free.push_back(i);
  for (int i = f.constants; i < f.g.size(); ++i) free.push_back(i);
  return free;
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

// Gusts seldom push where the centre of gravity is. How far above the origin they do is a nuisance of every
// model here: turns that go with pushes would else pass for a sensor, or a whole vehicle, that sits
// elsewhere. The turning accelerations of chunk k over that height, in units of a usual one.
std::vector<MatrixXd> gust_arm(const FlightRecord& record, const FlightSmoother& smoother,
                               const std::vector<double>& p) {
  if (record.layout.w_dot < 0 || record.layout.v_dot < 0) return {};
  std::vector<MatrixXd> profiles;
  for (const FlightState<double>& x : smoother.states()) {
    const Eigen::Vector3d push_B = rotation(x.body.q_WB).transpose() * x.outside.v_dot;
    MatrixXd P = MatrixXd::Zero(6, 1);
    const double h = kGustArm * payload_reach(*record.vehicle) * p[param::m];
    P(0, 0) = h * push_B[1] / p[param::Jxx], P(1, 0) = -h * push_B[0] / p[param::Jyy];
    profiles.push_back(P);
  }
  return profiles;
}

}  // namespace

QuadraticForm linearise_everything(const FlightRecord& record, const FlightFit& fit, const Theta& fitted,
                                   const ExtendedProblem& problem) {
  QuadraticForm form;
  std::vector<FreeConstant> constants = problem.constants;
  for (int i = 0; i < problem.base; ++i)
    constants[static_cast<std::size_t>(i)].start = fitted.physical(fit.u, i);
  const Theta theta(fitted.p(fit.u), constants, record.logs, record.signals.rates);
  FlightSmoother smoother(record, theta, fit.noise, fit.chunk_seconds);
  smoother.set_states(fit.smoother->states());
  smoother.set_steps(fit.smoother->steps());
  VectorXd u = VectorXd::Zero(theta.size());
  const int biases = theta.size() - theta.constants_count();
  u.tail(biases) = fit.u.tail(biases);
  smoother.linearize(u);  // the states are at their best already
  smoother.retune(10, false);
  smoother.set_profiles(gust_arm(record, smoother, theta.p(u)));
  smoother.relinearize();
  const ReducedSystem& system = smoother.reduced();
  smoother.accept();
  form.noise = smoother.noise();
  form.cost0 = system.cost;
  form.g = system.g;
  form.S = system.S;
  form.base = problem.base;
  form.constants = theta.constants_count();
  const Eigen::Index all = form.g.size();
  form.prior = theta.prior(u).extended(all), form.null = VectorXd::Zero(all);
  for (int i = 0; i < form.constants; ++i) {
    const FreeConstant& c = constants[static_cast<std::size_t>(i)];
    if (c.name.find('.') == std::string::npos || states_constant(*record.vehicle, c.name)) continue;
    form.null[i] = (find_parameter(c.name)->null_value - c.start) / c.unit();
  }
  // Variance of the scores over blocks, each projected on the base, over what white residuals would give.
  std::vector<MatrixXd> information;
  const std::vector<ScoreBlock> blocks = smoother.score_blocks(2.0);
  MatrixXd scores(all, static_cast<Eigen::Index>(blocks.size()));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    scores.col(static_cast<Eigen::Index>(b)) = blocks[b].score;
    information.push_back(blocks[b].information);
  }
  if (scores.cols() < 8) return form;
  const std::vector<int> base = base_unknowns(form, problem);
  const auto m = static_cast<Eigen::Index>(base.size());
  const MatrixXd H = form.S + form.prior.information();
  MatrixXd M(m, m), C(m, all);
  for (Eigen::Index a = 0; a < m; ++a) {
    const int i = base[static_cast<std::size_t>(a)];
    for (Eigen::Index b = 0; b < m; ++b) M(a, b) = H(i, base[static_cast<std::size_t>(b)]);
    M(a, a) += 1e-12 * (1 + form.S(i, i));
    C.row(a) = form.S.row(i);
  }
  const MatrixXd project = Eigen::LDLT<MatrixXd>(M).solve(C);
  MatrixXd P = MatrixXd::Identity(all, form.constants);
  for (int i = 0; i < form.constants; ++i)
    for (Eigen::Index a = 0; a < m; ++a)
      if (base[static_cast<std::size_t>(a)] != i) P(base[static_cast<std::size_t>(a)], i) -= project(a, i);
  form.scores = P.transpose() * scores;
  for (const MatrixXd& F : information) form.information.push_back(P.transpose() * (F * P));
  return form;
}

double stretch_of(const QuadraticForm& form, const std::vector<int>& directions) {
  const auto k = static_cast<Eigen::Index>(directions.size());
  const auto blocks = static_cast<Eigen::Index>(form.information.size());
  if (k == 0 || blocks < 8) return 1.0;
  const auto part = [&](const MatrixXd& F) {
    MatrixXd out(k, k);
    for (Eigen::Index a = 0; a < k; ++a)
      for (Eigen::Index b = 0; b < k; ++b)
        out(a, b) = F(directions[static_cast<std::size_t>(a)], directions[static_cast<std::size_t>(b)]);
    return out;
  };
  MatrixXd total = MatrixXd::Zero(k, k), s(k, blocks);
  for (Eigen::Index b = 0; b < blocks; ++b) total += part(form.information[static_cast<std::size_t>(b)]);
  for (Eigen::Index a = 0; a < k; ++a) s.row(a) = form.scores.row(directions[static_cast<std::size_t>(a)]);
  const VectorXd d = total.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = d.asDiagonal() * total * d.asDiagonal();
  scaled.diagonal().array() += 1e-9;
  const Eigen::LDLT<MatrixXd> solver(scaled);
  const VectorXd size = -(d.asDiagonal() * solver.solve(d.asDiagonal() * VectorXd(s.rowwise().sum())));
  MatrixXd left(k, blocks);
  for (Eigen::Index b = 0; b < blocks; ++b)
    left.col(b) = d.asDiagonal() * (s.col(b) + part(form.information[static_cast<std::size_t>(b)]) * size);
  const double n = static_cast<double>(blocks);
  return std::clamp((solver.solve(left * left.transpose())).trace() / static_cast<double>(k) * n / (n - 1),
                    1.0, 100.0);
}

SetGain gain_of(const QuadraticForm& form, const ExtendedProblem& problem, const std::vector<int>& members) {
  const std::vector<int> base = base_unknowns(form, problem);
  std::vector<int> free = base, dropped;
  std::vector<bool> on(static_cast<std::size_t>(form.constants), false);
  SetGain out;
  out.members = members;
  for (const int c : members) {
    const Candidate& candidate = problem.candidates[static_cast<std::size_t>(c)];
    if (candidate.parameter >= 0) {
      dropped.push_back(candidate.parameter);
      out.degrees += 1;
    }
    for (const int i : candidate.directions) {
      if (on[static_cast<std::size_t>(i)]) continue;
      on[static_cast<std::size_t>(i)] = true;
      free.push_back(i);
      out.degrees += 1;
    }
  }
  const auto own = static_cast<Eigen::Index>(free.size() - base.size());
  // Adopted effects that are not members go back to their null values.
  std::vector<std::pair<int, double>> off, all_off;
  for (int i = 0; i < form.constants; ++i) {
    if (form.null[i] == 0) continue;
    all_off.emplace_back(i, form.null[i]);
    if (!on[static_cast<std::size_t>(i)]) off.emplace_back(i, form.null[i]);
  }
  const Solved without = minimum(form, base, all_off, {});
  Solved with = minimum(form, free, off, dropped, own);
  for (const int c : members) {
    const Candidate& candidate = problem.candidates[static_cast<std::size_t>(c)];
    if (!candidate.positive || candidate.directions.empty()) continue;
    const int i = candidate.directions[0];
    const double least = least_of(candidate, problem, with.step - form.null);
    if (with.step[i] - form.null[i] >= least) continue;
    if (candidate.directions.size() == 1) {
      out.signs = false;
      continue;
    }
    // A payload too light to be weighed: its mass stays at the bound, its place may still show.
    off.emplace_back(i, form.null[i] + least);
    std::erase(free, i);
    const double price = with.price;
    with = minimum(form, free, off, dropped, own - 1);
    with.price = std::max(with.price, price - kPricePerDirection);
  }
  for (const int c : members) {
    const Candidate& candidate = problem.candidates[static_cast<std::size_t>(c)];
    const int i = candidate.height;
    if (i < 0 || std::ranges::find(free, i) == free.end()) continue;
    const auto moved = [&](int k) {
      return std::abs(problem.constants[static_cast<std::size_t>(k)].unit() * (with.step[k] - form.null[k]));
    };
    const double carried =
        candidate.mass_for_shift > 0 ? moved(candidate.directions[0]) / candidate.mass_for_shift : 0.0;
    if (moved(i) <= candidate.highest + carried) continue;
    off.emplace_back(i, form.null[i]);
    std::erase(free, i);
    out.degrees -= 1;
    with = minimum(form, free, off, dropped, static_cast<Eigen::Index>(free.size() - base.size()));
  }
  for (const int c : members)
    for (const int i : problem.candidates[static_cast<std::size_t>(c)].directions) {
      const FreeConstant& of = problem.constants[static_cast<std::size_t>(i)];
      const double size = std::abs(of.unit() * (with.step[i] - form.null[i]));
      if (size > kFarther * physical_limit(of)) out.sizes = false;
    }
  out.gain = with.drop - without.drop;
  out.step = with.step;
  out.price = with.price + kPricePerDirection * static_cast<double>(dropped.size());
  return out;
}

double deviation_of(const QuadraticForm& form, const ExtendedProblem& problem, int candidate, int direction) {
  const Candidate& c = problem.candidates[static_cast<std::size_t>(candidate)];
  const int target = c.parameter >= 0 ? c.parameter : c.directions[static_cast<std::size_t>(direction)];
  std::vector<int> free = base_unknowns(form, problem);
  if (c.parameter < 0) free.push_back(target);
  const auto m = static_cast<Eigen::Index>(free.size());
  const PriorTerms prior = c.parameter >= 0 ? form.prior.loosened(c.parameter, kDropped) : form.prior;
  const MatrixXd H = form.S + prior.information();
  MatrixXd M(m, m);
  Eigen::Index at = 0;
  for (Eigen::Index a = 0; a < m; ++a) {
    const int i = free[static_cast<std::size_t>(a)];
    if (i == target) at = a;
    for (Eigen::Index b = 0; b < m; ++b) M(a, b) = H(i, free[static_cast<std::size_t>(b)]);
  }
  const VectorXd s = M.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = s.asDiagonal() * M * s.asDiagonal();
  scaled.diagonal().array() += 1e-10;
  // What is stated of a parameter may be off by its own deviation as well.
  const double stated =
      c.parameter >= 0 && form.prior.slope[target] > 0 ? 1 / std::pow(form.prior.slope[target], 2) : 0.0;
  const double v = Eigen::LLT<MatrixXd>(scaled).solve(VectorXd::Unit(m, at))[at] * s[at] * s[at] + stated;
  return std::sqrt(std::max(v, 0.0) *
                   stretch_of(form, c.parameter >= 0 ? std::vector<int>{target} : c.directions)) *
         std::abs(problem.constants[static_cast<std::size_t>(target)].unit());
}

}  // namespace ident
