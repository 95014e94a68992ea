// The likelihood linearised over every cause at once.
#include "ident/gap/hypotheses/quadratic_form.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ident/core/stage_times.h"
#include "ident/effects/all_parameters.h"

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kFewestBlocks = 8;  // that tell a variance

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

std::vector<int> base_unknowns(const QuadraticForm& f, const ExtendedProblem& problem) {
  std::vector<int> free;
  for (int i = 0; i < problem.base; ++i)
    if (!problem.constants[static_cast<std::size_t>(i)].adopted) free.push_back(i);
  for (int i = f.constants; i < f.g.size(); ++i) free.push_back(i);
  return free;
}

void add_blocks(QuadraticForm& form, const std::vector<ScoreBlock>& blocks, const std::vector<int>& base) {
  if (blocks.size() < kFewestBlocks) return;
  const Eigen::Index all = form.g.size(), m = static_cast<Eigen::Index>(base.size());
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
  MatrixXd scores(all, static_cast<Eigen::Index>(blocks.size()));
  for (std::size_t b = 0; b < blocks.size(); ++b) scores.col(static_cast<Eigen::Index>(b)) = blocks[b].score;
  form.scores = P.transpose() * scores;
  for (const ScoreBlock& block : blocks) form.information.push_back(P.transpose() * (block.information * P));
}

QuadraticForm linearise_everything(const FlightRecord& record, const FlightFit& fit, const Theta& fitted,
                                   const ExtendedProblem& problem) {
  const Stage stage("every cause linearised");
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
  add_blocks(form, smoother.score_blocks(2.0), base_unknowns(form, problem));
  return form;
}

double stretch_of(const QuadraticForm& form, const std::vector<int>& directions) {
  const auto k = static_cast<Eigen::Index>(directions.size());
  const auto blocks = static_cast<Eigen::Index>(form.information.size());
  if (k == 0 || blocks < static_cast<Eigen::Index>(kFewestBlocks)) return 1.0;
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

}  // namespace ident
