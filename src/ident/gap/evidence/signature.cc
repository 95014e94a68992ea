// Compares every chunk of flight with the model found, with and without the cause, from the same state.
#include "ident/gap/evidence/signature.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ident/effects/all_parameters.h"
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
    if (!is_constant_of(cause, c, static_cast<int>(i))) continue;
    const auto index = static_cast<std::size_t>(c.index);
    out.off.emplace_back(index, cause.parameter >= 0 ? base[index] : find_parameter(c.name)->null_value);
    out.only = out.off.size() == 1 ? static_cast<int>(i) : -1;
  }
  return out;
}

/// What the measurements of each chunk lack of a model with constants p, in the channels of the residual
/// wrench: means and slopes of measured minus predicted, from the states of a fit and without any push from
/// outside. Nothing is smoothed in it, so it is not drawn towards zero. NaN where nothing was sampled.
class Lack {
 public:
  Lack(const FlightRecord& record, const FittedModel& base)
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

  /// What white noise of the sensors puts into a row.
  VectorXd noise(const NoiseModel& white, Index channels) const {
    const FlightSmoother& smoother = *base_.fit.smoother;
    const bool force = record_.signals.force;
    const double h = smoother.chunk_seconds(), n = std::max(h / record_.interval, 2.0);
    const double mean = 1 / std::sqrt(n), slope = std::sqrt(12 / n) / h;
    VectorXd out(channels);
    for (Index c = 0; c < channels; ++c) {
      const auto at = static_cast<std::size_t>(c);
      out[c] = c >= 6   ? slope * white.sigma[kRotorChannel + at - 6]
               : c >= 3 ? slope * white.sigma[kGyro + at - 3] * p_base_[inertia_[at - 3]]
               : force  ? mean * white.sigma[kForce + at] * p_base_[param::m]
                        : slope * white.sigma[kVelocity + at] * p_base_[param::m];
    }
    return out;
  }

 private:
  Eigen::RowVectorXd row(std::size_t k, const std::vector<double>& p, Index channels) const {
    const FlightSmoother& smoother = *base_.fit.smoother;
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record_.arcs[static_cast<std::size_t>(place.arc)];
    ChunkTask task;
    task.vehicle = record_.vehicle, task.inputs = arc.inputs.get(), task.layout = record_.layout;
    task.p = p, task.active = active_effects(p);
    task.gyro_bias = base_.theta->gyro_bias(base_.fit.u, arc.log);
    task.begin = place.begin, task.end = place.end, task.rows = arc.rows();
    task.t = arc.t.data(), task.y = arc.y.data(), task.q = arc.q.data();
    task.weight = weight_.data(), task.x0 = smoother.states()[k], task.jacobian = false;
    task.x0.outside = {};
    ChunkResult result;
    evaluate_chunk(task, result);
    const auto line = [&](std::size_t channel) { return line_of(result, arc, place, channel); };
    const Eigen::Vector3d v_dot_W{line(kVelocity).slope, line(kVelocity + 1).slope,
                                  line(kVelocity + 2).slope};
    const Eigen::Vector3d v_dot_B = rotation(task.x0.body.q_WB).transpose() * v_dot_W;
    Eigen::RowVectorXd out(channels);
    for (Index c = 0; c < 3; ++c) {
      const auto at = static_cast<std::size_t>(c);
      out[c] = p_base_[param::m] * (record_.signals.force ? line(kForce + at).mean : v_dot_B[c]);
      out[3 + c] = p_base_[inertia_[at]] * line(kGyro + at).slope;
    }
    for (Index c = 6; c < channels; ++c) out[c] = line(kRotorChannel + static_cast<std::size_t>(c - 6)).slope;
    return out;
  }

  struct Line {
    double mean = kNaN, slope = kNaN;
  };
  // Of measured minus predicted over the time of a chunk.
  Line line_of(const ChunkResult& result, const FlightArc& arc, const ChunkPlace& place,
               std::size_t channel) const {
    double n = 0, t1 = 0, t2 = 0, y1 = 0, ty = 0;
    for (std::size_t i = 0; i < place.end - place.begin; ++i) {
      const double y = -result.residuals[i * kChannels + channel] / weight_[channel];
      const double t = arc.t[place.begin + i] - arc.t[place.begin];
      if (std::isfinite(y)) n += 1, t1 += t, t2 += t * t, y1 += y, ty += t * y;
    }
    const double spread = n * t2 - t1 * t1;
    return {n > 0 ? y1 / n : kNaN, spread > 0 ? (n * ty - t1 * y1) / spread : kNaN};
  }

  static constexpr std::array<std::size_t, 3> inertia_{param::Jxx, param::Jyy, param::Jzz};
  const FlightRecord& record_;
  const FittedModel& base_;
  std::vector<double> p_base_;
  std::array<double, kChannels> weight_{};
};

std::string name_of(Index channel) {
  constexpr std::array<const char*, 6> kWrench{"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  return channel < 6 ? kWrench[static_cast<std::size_t>(channel)] : "rotor" + std::to_string(channel - 5);
}

void fit_line(Signature& s) {
  const Eigen::Map<const VectorXd> x(s.x.data(), static_cast<Index>(s.x.size())),
      y(s.y.data(), static_cast<Index>(s.y.size()));
  if (x.size() < 3 || !(x.squaredNorm() > 0)) return;
  s.slope = x.dot(y) / x.squaredNorm();
  s.slope_std =
      std::sqrt((y - s.slope * x).squaredNorm() / (static_cast<double>(x.size() - 1) * x.squaredNorm()));
  const VectorXd dx = x.array() - x.mean(), dy = y.array() - y.mean();
  s.correlation = dx.dot(dy) / std::max(std::sqrt(dx.squaredNorm() * dy.squaredNorm()), 1e-300);
}

// Of the forces, of the moments and of the rotors that one where the prediction is largest over the noise,
// largest first; those below the noise only where all are.
std::vector<Index> shown_channels(const MatrixXd& predicted, const VectorXd& noise) {
  VectorXd size(predicted.cols());
  for (Index c = 0; c < size.size(); ++c) {
    const auto finite = predicted.col(c).array().isFinite();
    const double n = static_cast<double>(finite.count());
    size[c] =
        std::sqrt(finite.select(predicted.col(c).array().square(), 0.0).sum() / std::max(n, 1.0)) / noise[c];
  }
  std::vector<std::pair<double, Index>> best;
  for (const auto& [first, last] : {std::pair<Index, Index>{0, 3}, {3, 6}, {6, size.size()}}) {
    if (first >= last) continue;
    Index at = 0;
    const double top = size.segment(first, last - first).maxCoeff(&at);
    best.emplace_back(-top, first + at);
  }
  std::ranges::sort(best);
  while (best.size() > 1 && best.back().first > -1) best.pop_back();
  std::vector<Index> channels;
  for (const auto& [top, channel] : best) channels.push_back(channel);
  return channels;
}

Signature signature_of(const Candidate& cause, const Switch& off, const MatrixXd& predicted,
                       const MatrixXd& lacking, const FittedModel& best, Index channel) {
  Signature out{.cause = described(cause)};
  out.channel = name_of(channel);
  if (off.only >= 0) {
    const FreeConstant& c = best.theta->constants()[static_cast<std::size_t>(off.only)];
    out.parameter = c.name.substr(0, c.name.find('@')), out.parameter_unit = parameter_unit(c.name);
    out.found = best.theta->physical(best.fit.u, off.only) - off.off.front().second;
    out.found_std = best.theta->deviation(best.fit.u, off.only, best.fit.covariance);
  }
  const Index stride = (predicted.rows() + kMostPoints - 1) / kMostPoints;
  for (Index k = 0; k < predicted.rows(); k += stride) {
    if (!std::isfinite(lacking(k, channel))) continue;
    out.x.push_back(predicted(k, channel) / out.found);
    out.y.push_back(lacking(k, channel));
  }
  fit_line(out);
  return out;
}

}  // namespace

std::vector<Signature> signatures(const FlightRecord& record, const SearchResult& search) {
  std::vector<Signature> out;
  if (search.best.adopted.empty()) return out;
  const std::vector<double> base = search.base.theta->p(search.base.fit.u),
                            best = search.best.theta->p(search.best.fit.u);
  const Lack lack(record, search.base);
  const Index channels = 6 + (record.signals.rotor_speeds ? record.layout.rotors : 0);
  const MatrixXd with_best = lack.of(best, channels);
  const VectorXd noise = lack.noise(search.form.noise, channels);
  for (const Candidate& cause : search.best.adopted) {
    const Switch off = switch_of(cause, search.best, base);
    if (off.off.empty()) continue;
    std::vector<double> without = best;
    for (const auto& [index, value] : off.off) without[index] = value;
    const MatrixXd lacking = lack.of(without, channels), predicted = lacking - with_best;
    for (const Index channel : shown_channels(predicted, noise)) {
      out.push_back(signature_of(cause, off, predicted, lacking, search.best, channel));
      out.back().noise = noise[channel];
    }
  }
  return out;
}

}  // namespace ident
