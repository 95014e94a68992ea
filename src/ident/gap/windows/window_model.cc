// Gauss-Newton steps over both sides, and the quadratic form with every cause free.
#include "ident/gap/windows/window_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "ident/core/parallel.h"
#include "ident/core/statistics.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/effects/cause_traits.h"
#include "ident/flight/ladder/error_by_speed.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLateral = 0.1;  // unit of the lateral share of the thrust: six degrees
constexpr double kTurning =
    100.0;  // rad/s^2, unit of a lasting angular acceleration: of the smallest vehicles
constexpr Index kTrimOfForces = 4, kTrimOfMoments = 3;  // of each log
constexpr double kApart = 1e-3;                         // of a unit, for differences
constexpr double kRelated = 2.0;                        // s over which residuals are taken for related
constexpr int kSteps = 5;
constexpr double kStill = 1e-3;      // of a unit: no step worth another
constexpr std::size_t kFewest = 60;  // windows
constexpr int kWeighings = 3;

// Causes of forces and moments that change along a flight in which attitude, rates and velocity are as
// measured. What makes a lasting moment or a lateral force is not told from trim, and moving air is not
// measured.
bool shows_in_windows(const std::string& cause) {
  constexpr unsigned kActs = kTouchFlow | kTouchRotor | kTouchGain | kTouchSpin | kTouchHeight;
  const EffectEntry* effect = find_effect(cause);
  const CauseTraits& traits = traits_of(cause);
  return effect && (effect->info.touches & kActs) != 0 && !traits.per_rotor && !traits.by_the_air &&
         !traits.moves_mass;
}

// The trim's columns: a force across the rotors that goes with their thrust, and a steady wind's push; or a
// moment that lasts.
VectorXd trim_column(const WindowModel& flight, const std::vector<ModelAlong>& model, int log, Index axis) {
  const MeasuredMotion& motion = flight.motion();
  VectorXd column = VectorXd::Zero(3 * static_cast<Index>(flight.windows().size()));
  std::vector<std::vector<Vec3<double>>> gained;
  for (std::size_t a = 0; a < motion.arcs.size(); ++a) {
    const MeasuredArc& arc = motion.arcs[a];
    std::vector<Vec3<double>>& sum = gained.emplace_back(arc.t.size(), Vec3<double>::Zero());
    if (arc.arc->log != log) continue;
    for (std::size_t i = 1; i < arc.t.size(); ++i) {
      Vec3<double> step = Vec3<double>::Zero();
      const double dt = arc.t[i] - arc.t[i - 1];
      if (flight.what() == FitTo::moments)
        step[axis] = kTurning * dt;
      else if (axis >= 2)
        step[axis - 2] = kLateral * flight.record().vehicle->g * dt;
      else
        step = kLateral * (model[a].gained_W[i] - model[a].gained_W[i - 1]).norm() *
               rotation(arc.body[i].q_WB).col(axis);
      sum[i] = sum[i - 1] + step;
    }
  }
  for (std::size_t w = 0; w < flight.windows().size(); ++w) {
    const Window& window = flight.windows()[w];
    column.segment<3>(3 * static_cast<Index>(w)) =
        gained[window.arc][window.end] - gained[window.arc][window.begin];
  }
  return -column;
}

// What was known. Of the size of an effect, that physics limits it: a normal distribution about none, with
// its limit at two deviations.
PriorTerms everything_known(const Theta& theta, const VectorXd& u, const VectorXd& trim) {
  PriorTerms prior = theta.prior(u).extended(u.size() + trim.size());
  prior.residual.tail(trim.size()) = trim;
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    const EffectParameter* effect = find_effect_parameter(c.name);
    if (c.prior_std || !effect) continue;
    const double size = 0.5 * physical_limit(c);
    prior.residual[i] = (theta.physical(u, i) - effect->null_value) / size;
    prior.slope[i] = theta.slope(u, i) / size;
  }
  const double least = std::sqrt(1e-9);
  prior.slope = prior.slope.unaryExpr([&](double s) { return std::abs(s) < least ? least : s; });
  return prior;
}

struct Normal {
  MatrixXd H;
  VectorXd g;
};
Normal normal_of(const WindowMisses& m) {
  const MatrixXd WJ = m.weight.asDiagonal() * m.slopes;
  return {m.slopes.transpose() * WJ, WJ.transpose() * m.missed};
}

// Variance of the scores of blocks over that of independent windows, for each unknown.
VectorXd colour_of(const std::vector<ScoreBlock>& blocks, const VectorXd& information) {
  VectorXd sum = VectorXd::Zero(information.size());
  for (const ScoreBlock& block : blocks) sum += block.score.cwiseAbs2();
  return sum.cwiseQuotient(information.cwiseMax(1e-300)).cwiseMax(1.0);
}

}  // namespace

WindowModel::WindowModel(const FlightRecord& record, FitTo what, std::vector<std::string> settled)
    : record_(record), what_(what), settled_(std::move(settled)), motion_(measured_motion(record)) {
  if (motion_.arcs.empty() || !(what == FitTo::forces ? motion_.forces : motion_.moments)) return;
  windows_ = windows_of(motion_, what);
  if (windows_.size() < kFewest) windows_.clear();
}

Index WindowModel::trim_size() const {
  return record_.logs * (what_ == FitTo::forces ? kTrimOfForces : kTrimOfMoments);
}

WindowMisses WindowModel::linearised(const Theta& theta, const VectorXd& u, const VectorXd& trim) const {
  const std::vector<ModelAlong> here = model_along(motion_, theta.p(u));
  WindowMisses out{missed_in(motion_, windows_, what_, here), {}, {}};
  out.slopes = MatrixXd::Zero(out.missed.size(), u.size() + trim.size());
  in_parallel(static_cast<std::size_t>(u.size()), [&](std::size_t i) {
    VectorXd moved = u;
    moved[static_cast<Index>(i)] += kApart;
    const VectorXd there = missed_in(motion_, windows_, what_,
                                     model_along(motion_, theta.p(moved), here, theta.constants()[i].index));
    out.slopes.col(static_cast<Index>(i)) = (there - out.missed) / kApart;
  });
  Index at = u.size();
  for (int log = 0; log < record_.logs; ++log)
    for (Index axis = 0; axis < trim.size() / record_.logs; ++axis)
      out.slopes.col(at++) = trim_column(*this, here, log, axis);
  out.missed += out.slopes.rightCols(trim.size()) * trim;
  return out;
}

// Errors of the model as they are with all of theta free, growing with speed; and by how much they hang
// together.
void WindowModel::weigh(WindowMisses& misses, const Theta& theta, const VectorXd& u) const {
  misses.weight = weight_by_speed(windows_, misses.missed);
  const MatrixXd known = everything_known(theta, u, VectorXd::Zero(trim_size())).information();
  WindowMisses there = misses;
  for (int round = 0; round < kWeighings; ++round) {
    const Normal normal = normal_of(misses);
    there.missed = misses.missed - misses.slopes * MatrixXd(normal.H + known).ldlt().solve(normal.g);
    there.weight = misses.weight = weight_by_speed(windows_, there.missed);
  }
  const VectorXd information = normal_of(there).H.diagonal(),
                 colour = colour_of(blocks_of(there), information);
  std::vector<double> told;
  for (Index i = 0; i < colour.size(); ++i)
    if (information[i] > kHidden) told.push_back(colour[i]);
  if (!told.empty()) misses.weight /= median(told);
}

std::vector<ScoreBlock> WindowModel::blocks_of(const WindowMisses& m) const {
  std::map<std::pair<std::size_t, long>, ScoreBlock> blocks;
  const Index n = m.slopes.cols();
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    const long at = std::lround(std::floor(windows_[w].t / kRelated));
    ScoreBlock& block = blocks[{windows_[w].arc, at}];
    if (block.score.size() == 0) {
      block.arc = static_cast<int>(windows_[w].arc), block.from = kRelated * static_cast<double>(at);
      block.to = block.from + kRelated;
      block.score = VectorXd::Zero(n), block.information = MatrixXd::Zero(n, n);
    }
    const Index row = 3 * static_cast<Index>(w);
    const MatrixXd WJ = m.weight.segment<3>(row).asDiagonal() * m.slopes.middleRows(row, 3);
    block.score += WJ.transpose() * m.missed.segment<3>(row);
    block.information += WJ.transpose() * m.slopes.middleRows(row, 3);
  }
  std::vector<ScoreBlock> out;
  for (auto& [place, block] : blocks) out.push_back(std::move(block));
  return out;
}

struct WindowModel::Fitted {
  FittedModel model;
  VectorXd trim;
};

WindowModel::Fitted WindowModel::fitted(std::vector<FreeConstant> constants, std::vector<Candidate> adopted,
                                        const std::vector<double>& p) const {
  Fitted out;
  FittedModel& model = out.model;
  model.constants = constants;
  model.adopted = std::move(adopted);
  model.theta = std::make_shared<Theta>(p, std::move(constants), record_.logs, false);
  const Theta& theta = *model.theta;
  VectorXd u = VectorXd::Zero(theta.size());
  out.trim = VectorXd::Zero(trim_size());
  WindowMisses misses;
  Normal normal;
  PriorTerms prior;
  for (int round = 0; round < kSteps; ++round) {
    misses = linearised(theta, u, out.trim);
    weigh(misses, theta, u);
    normal = normal_of(misses);
    prior = everything_known(theta, u, out.trim);
    const MatrixXd A = normal.H + prior.information();
    const VectorXd step = -A.ldlt().solve(normal.g + prior.gradient());
    if (!step.allFinite()) break;
    // A constant that is a logarithm moves by no more than a factor of e at once.
    double most = 1;
    for (int i = 0; i < theta.constants_count(); ++i)
      if (theta.constants()[static_cast<std::size_t>(i)].positive) most = std::max(most, std::abs(step[i]));
    u += step.head(u.size()) / most, out.trim += step.tail(out.trim.size()) / most;
    if (step.head(u.size()).cwiseAbs().maxCoeff() < kStill) break;
  }
  FlightFit& fit = model.fit;
  fit.u = u;
  const Index n = u.size();
  const MatrixXd inverse = MatrixXd(normal.H + prior.information()).inverse();
  fit.naive_covariance = inverse.topLeftCorner(n, n);
  // As wide as scores of blocks scatter, each by itself: few blocks tell no more.
  MatrixXd scatter = prior.information();
  for (const ScoreBlock& block : blocks_of(misses)) scatter += block.score * block.score.transpose();
  const VectorXd wider = (inverse * scatter * inverse)
                             .diagonal()
                             .head(n)
                             .cwiseQuotient(fit.naive_covariance.diagonal())
                             .cwiseMax(1.0)
                             .cwiseSqrt();
  fit.covariance = wider.asDiagonal() * fit.naive_covariance * wider.asDiagonal();
  fit.information = normal.H.topLeftCorner(n, n);
  fit.cost = misses.weight.dot(misses.missed.cwiseAbs2());
  fit.converged = fit.covariance.allFinite();
  return out;
}

WindowStanding WindowModel::standing(const Vehicle& vehicle, const std::vector<std::string>& exclude,
                                     std::vector<FreeConstant> constants, std::vector<Candidate> adopted,
                                     const std::vector<double>& p) const {
  Fitted found = fitted(std::move(constants), std::move(adopted), p);
  WindowStanding out{{std::move(found.model), {}, {}, {}}, std::move(found.trim), {}};
  Standing& at = out.at;
  at.problem = extended_problem(vehicle, at.model.theta->p(at.model.fit.u), record_.signals,
                                at.model.constants, exclude);
  std::erase_if(at.problem.candidates, [&](const Candidate& c) {
    return !shows_in_windows(c.name) || std::ranges::find(settled_, c.name) != settled_.end();
  });
  std::vector<FreeConstant> all = at.problem.constants;
  for (int i = 0; i < at.problem.base; ++i)
    all[static_cast<std::size_t>(i)].start = at.model.theta->physical(at.model.fit.u, i);
  const Theta theta(at.model.theta->p(at.model.fit.u), all, record_.logs, false);
  const VectorXd u = VectorXd::Zero(theta.size());
  out.misses = linearised(theta, u, out.trim);
  weigh(out.misses, theta, u);
  const Normal normal = normal_of(out.misses);
  QuadraticForm& form = at.form;
  form.S = normal.H, form.g = normal.g, form.cost0 = out.misses.weight.dot(out.misses.missed.cwiseAbs2());
  form.prior = everything_known(theta, u, out.trim);
  form.null = VectorXd::Zero(form.g.size());
  form.base = at.problem.base, form.constants = theta.constants_count();
  for (int i = 0; i < form.constants; ++i) {
    const FreeConstant& c = all[static_cast<std::size_t>(i)];
    if (c.name.find('.') == std::string::npos || states_constant(vehicle, c.name)) continue;
    form.null[i] = (find_parameter(c.name)->null_value - c.start) / c.unit();
  }
  const auto hidden = [&](int i) { return form.S(i, i) < kHidden; };
  for (Candidate& c : at.problem.candidates) std::erase_if(c.directions, hidden);
  std::erase_if(at.problem.candidates, [](const Candidate& c) { return c.directions.empty(); });
  add_blocks(form, blocks_of(out.misses), base_unknowns(form, at.problem));
  at.have = places_of(at.model.adopted, at.problem);
  return out;
}

double sensor_variance(const MeasuredMotion& motion, FitTo what) {
  constexpr double kThirdDifference = 20.0;  // sum of the squares of 1, 3, 3, 1
  std::vector<double> seen;
  for (const MeasuredArc& arc : motion.arcs)
    for (std::size_t i = 3; i < arc.t.size(); ++i) {
      const auto at = [&](std::size_t k) {
        return what == FitTo::forces ? arc.gained_W[k] : arc.body[k].w_B;
      };
      const Vec3<double> d = at(i) - 3 * at(i - 1) + 3 * at(i - 2) - at(i - 3);
      for (int k = 0; k < 3; ++k) seen.push_back(d[k]);
    }
  if (seen.empty()) return 0;
  const double scale = mad_scale(seen, 0.0);
  return 2 * scale * scale / kThirdDifference;  // of a difference of two rows
}

ResidualWrench wrench_of(const WindowModel& model, const WindowStanding& standing) {
  ResidualWrench out;
  const std::vector<double> p = standing.at.model.theta->p(standing.at.model.fit.u);
  const bool forces = model.what() == FitTo::forces;
  const double seconds = horizon_of(model.what());
  const Vec3<double> inertia(p[param::Jxx], p[param::Jyy], p[param::Jzz]);
  const Vec3<double> unit = forces ? Vec3<double>::Constant(p[param::m]) : inertia;
  for (const char* axis : {"x", "y", "z"}) out.names.push_back((forces ? "F" : "M") + std::string(axis));
  out.residual = MatrixXd::Zero(static_cast<Index>(model.windows().size()), 3);
  for (std::size_t w = 0; w < model.windows().size(); ++w) {
    const Window& window = model.windows()[w];
    const MeasuredArc& arc = model.motion().arcs[window.arc];
    out.t.push_back(window.t), out.log.push_back(arc.arc->log);
    Vec3<double> rate = standing.misses.missed.segment<3>(3 * static_cast<Index>(w)) / seconds;
    if (forces) rate = rotation(arc.body[(window.begin + window.end) / 2].q_WB).transpose() * rate;
    out.residual.row(static_cast<Index>(w)) = rate.cwiseProduct(unit).transpose();
  }
  out.noise = std::max(std::sqrt(sensor_variance(model.motion(), model.what())) / seconds, 1e-9) * unit;
  return out;
}

}  // namespace ident
