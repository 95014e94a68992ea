// Runs every chunk of the base model's flight with and without the cause, from the same state.
#include "ident/gap/signature.h"

#include <algorithm>
#include <cmath>

#include "ident/effects/catalogue.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kMostPoints = 2000;

/// Constants of the model found that a cause sets, by index, with their values without it.
struct Switch {
  std::vector<std::pair<std::size_t, double>> off;
  int only = -1;  ///< unknown of theta where there is one alone
};

Switch switch_of(const Candidate& cause, const FittedModel& best, const std::vector<double>& base) {
  Switch out;
  const auto& constants = best.theta->constants();
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const FreeConstant& c = constants[i];
    const bool own = cause.parameter >= 0 ? static_cast<int>(i) == cause.parameter
                                          : c.name.substr(0, c.name.find('.')) == cause.name;
    const auto at = c.name.find('@');
    const bool other_rotor = at != std::string::npos && cause.rotor + 1 != std::stoi(c.name.substr(at + 1));
    if (!own || other_rotor) continue;
    const auto index = static_cast<std::size_t>(c.index);
    out.off.emplace_back(index, cause.parameter >= 0 ? base[index] : find_parameter(c.name)->null_value);
    out.only = out.off.size() == 1 ? static_cast<int>(i) : -1;
  }
  return out;
}

/// What the model with constants p expects of each chunk in the channels of the residual, from the states of
/// a fit. Only differences mean something.
class Expectation {
 public:
  Expectation(const FlightRecord& record, const FittedModel& base)
      : record_(record), base_(base), p_base_(base.theta->p(base.fit.u)) {
    for (std::size_t c = 0; c < kChannels; ++c) weight_[c] = 1.0 / base.fit.noise.sigma[c];
  }

  MatrixXd of(const std::vector<double>& p, Index channels) const {
    const FlightSmoother& smoother = *base_.fit.smoother;
    MatrixXd out(static_cast<Index>(smoother.chunks().size()), channels);
    smoother.in_parallel(smoother.chunks().size(),
                         [&](std::size_t k) { out.row(static_cast<Index>(k)) = row(k, p, channels); });
    return out;
  }

 private:
  Eigen::RowVectorXd row(std::size_t k, const std::vector<double>& p, Index channels) const {
    const FlightSmoother& smoother = *base_.fit.smoother;
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record_.arcs[static_cast<std::size_t>(place.arc)];
    ChunkTask task;
    task.vehicle = record_.vehicle, task.inputs = &arc.inputs, task.layout = record_.layout;
    task.p = p, task.active = active_effects(p);
    task.gyro_bias = base_.theta->gyro_bias(base_.fit.u, arc.log);
    task.begin = place.begin, task.end = place.end, task.rows = arc.rows();
    task.t = arc.t.data(), task.y = arc.y.data(), task.q = arc.q.data();
    task.weight = weight_.data(), task.x0 = smoother.states()[k], task.jacobian = false;
    ChunkResult result;
    evaluate_chunk(task, result);
    const double h = arc.t[place.end] - arc.t[place.begin], m = p_base_[param::m];
    const Eigen::Vector3d J{p_base_[param::Jxx], p_base_[param::Jyy], p_base_[param::Jzz]};
    const FlightState<double>& end = result.x_end;
    const Eigen::Vector3d v_dot_B = rotation(task.x0.body.q_WB).transpose() * end.body.v_W / h;
    Eigen::RowVectorXd out(channels);
    for (Index c = 0; c < 3; ++c) {
      double sum = 0, count = 0;
      for (std::size_t i = 0; i < place.end - place.begin; ++i) {
        const std::size_t at = kForce + static_cast<std::size_t>(c);
        const double r = result.residuals[i * kChannels + at];
        if (std::isfinite(r)) sum += r / weight_[at], count += 1;
      }
      out[c] = m * (count > 0 ? sum / count : v_dot_B[c]);
      out[3 + c] = J[c] * end.body.w_B[c] / h;
    }
    for (Index c = 6; c < channels; ++c) out[c] = end.motors[static_cast<std::size_t>(c - 6)].Omega / h;
    return out;
  }

  const FlightRecord& record_;
  const FittedModel& base_;
  std::vector<double> p_base_;
  std::array<double, kChannels> weight_{};
};

void fit_line(Signature& s) {
  const Eigen::Map<const VectorXd> x(s.x.data(), static_cast<Index>(s.x.size())),
      y(s.y.data(), static_cast<Index>(s.y.size()));
  if (x.size() < 3 || !(x.squaredNorm() > 0)) return;
  s.slope = x.dot(y) / x.squaredNorm();
  const VectorXd dx = x.array() - x.mean(), dy = y.array() - y.mean();
  s.correlation = dx.dot(dy) / std::max(std::sqrt(dx.squaredNorm() * dy.squaredNorm()), 1e-300);
}

Signature signature_of(const Candidate& cause, const Switch& off, const MatrixXd& predicted,
                       const MatrixXd& lacking, const ResidualWrench& before, const FittedModel& best) {
  Signature out{.cause = described(cause)};
  Index channel = 0;
  predicted.colwise().squaredNorm().cwiseQuotient(before.noise.transpose().cwiseAbs2()).maxCoeff(&channel);
  out.channel = before.names[static_cast<std::size_t>(channel)];
  out.noise = before.noise[channel];
  if (off.only >= 0) {
    const FreeConstant& c = best.theta->constants()[static_cast<std::size_t>(off.only)];
    out.parameter = c.name.substr(0, c.name.find('@')), out.parameter_unit = parameter_unit(c.name);
    out.found = best.theta->physical(best.fit.u, off.only) - off.off.front().second;
    out.found_std = std::abs(best.theta->slope(best.fit.u, off.only)) *
                    std::sqrt(best.fit.covariance(off.only, off.only));
  }
  const Index stride = (predicted.rows() + kMostPoints - 1) / kMostPoints;
  for (Index k = 0; k < predicted.rows(); k += stride) {
    out.x.push_back(predicted(k, channel) / out.found);
    out.y.push_back(lacking(k, channel));
  }
  fit_line(out);
  return out;
}

}  // namespace

std::vector<Signature> signatures(const FlightRecord& record, const SearchResult& search,
                                  const ResidualWrench& before) {
  std::vector<Signature> out;
  if (search.best.adopted.empty()) return out;
  const std::vector<double> base = search.base.theta->p(search.base.fit.u),
                            best = search.best.theta->p(search.best.fit.u);
  const Expectation expectation(record, search.base);
  const Index channels = before.residual.cols();
  const MatrixXd with_base = expectation.of(base, channels), with_best = expectation.of(best, channels);
  for (const Candidate& cause : search.best.adopted) {
    const Switch off = switch_of(cause, search.best, base);
    if (off.off.empty()) continue;
    std::vector<double> without = best;
    for (const auto& [index, value] : off.off) without[index] = value;
    const MatrixXd taken_out = expectation.of(without, channels);
    out.push_back(signature_of(cause, off, with_best - taken_out, before.residual + with_base - taken_out,
                               before, search.best));
  }
  return out;
}

}  // namespace ident
