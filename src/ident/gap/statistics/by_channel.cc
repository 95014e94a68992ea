// Scores along each cause found, part by part.
#include "ident/gap/statistics/by_channel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numeric>

#include "ident/flight/fit/fit_steps.h"

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBlock = 2.0;        // s
constexpr double kLeastShare = 1e-6;  // of what is known of a size; a part that tells less is silent

// Channels that tell of one motion, and the components of the local state (1 or 0) whose links go with them.
struct Part {
  std::string name;
  std::array<bool, kChannels> channels{};
  VectorXd states;
};

std::vector<Part> parts_of(const FlightRecord& record) {
  const StateLayout& layout = record.layout;
  static constexpr std::array names = {"roll", "pitch", "yaw", "level", "level", "height"};
  std::vector<Part> parts;
  const auto part_named = [&](const std::string& name) -> Part& {
    const auto at = std::ranges::find(parts, name, &Part::name);
    return at != parts.end() ? *at : parts.emplace_back(Part{name, {}, VectorXd::Zero(layout.size)});
  };
  const auto add = [&](int name, int axis, std::initializer_list<int> channels,
                       std::initializer_list<int> states) {
    Part& part = part_named(names[static_cast<std::size_t>(name)]);
    for (const int c : channels) part.channels[static_cast<std::size_t>(c + axis)] = true;
    for (const int first : states)
      if (first >= 0) part.states[first + axis] = 1;
  };
  for (int k = 0; k < 3; ++k)
    add(k, k, {kGyro, kAttitude},
        {layout.w, layout.attitude, layout.w_dot, layout.shown_error[kShownAttitude]});
  for (int k = 0; k < 3; ++k)
    add(k + 3, k, {kForce, kVelocity, kPosition},
        {layout.v, layout.x, layout.v_dot, layout.shown_error[kShownVelocity],
         layout.shown_error[kShownPosition]});
  if (layout.motors < 0) return parts;
  // Motors that nobody measures may stray a little from their equation, and that little says something too.
  Part& motors = part_named(record.signals.rotor_speeds ? "rotor speeds" : "motors (not measured)");
  for (int n = 0; n < layout.rotors; ++n) motors.channels[static_cast<std::size_t>(kRotorChannel + n)] = true;
  motors.states.segment(layout.motors, 2 * layout.rotors).setOnes();
  return parts;
}

// Step of the unknowns of a cause that takes it from none to what was found.
VectorXd whole_size(const FittedModel& model, const Candidate& cause) {
  const Theta& theta = *model.theta;
  VectorXd d = VectorXd::Zero(theta.size());
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    if (!is_constant_of(cause, c, i)) continue;
    d[i] = (theta.physical(model.fit.u, i) - value_without(cause, c)) / theta.slope(model.fit.u, i);
  }
  return d;
}

double sum_of(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); }

// Score and information along a step, [part][block of flight].
struct Told {
  std::vector<std::vector<double>> score, information;
};
Told told(const FlightSmoother& smoother, const FlightSmoother::Along& along,
          const std::vector<Part>& parts) {
  Told out{std::vector<std::vector<double>>(parts.size()), std::vector<std::vector<double>>(parts.size())};
  int arc = -1;
  double from = 0;
  for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const double t = smoother.record().arcs[static_cast<std::size_t>(place.arc)].t[place.begin];
    if (place.arc != arc || t - from >= kBlock) {
      arc = place.arc, from = t;
      for (auto& of_part : out.score) of_part.push_back(0);
      for (auto& of_part : out.information) of_part.push_back(0);
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
      double &score = out.score[p].back(), &information = out.information[p].back();
      for (std::size_t i = 0; i < along.residuals[k].size(); ++i) {
        const double r = along.residuals[k][i], slope = along.residual_slopes[k][i];
        if (!parts[p].channels[i % kChannels] || !std::isfinite(r) || !std::isfinite(slope)) continue;
        const double weight = std::min(1.0, smoother.huber() / std::max(std::abs(r), 1e-300));
        score += weight * r * slope, information += weight * slope * slope;
      }
      if (!place.linked) continue;
      const VectorXd weighted =
          along.weights[k].cwiseProduct(parts[p].states).cwiseProduct(along.defect_slopes[k]);
      score += weighted.dot(along.defects[k]), information += weighted.dot(along.defect_slopes[k]);
    }
  }
  return out;
}

}  // namespace

std::vector<std::vector<Asked>> asked_by_channels(const FittedModel& model) {
  const Theta& theta = *model.theta;
  FlightSmoother& smoother = *model.fit.smoother;
  const std::vector<Part> parts = parts_of(smoother.record());
  const PriorTerms prior = theta.prior(model.fit.u);
  const MatrixXd H = model.fit.information + prior_information(theta, model.fit.u);
  std::vector<std::vector<Asked>> out;
  for (const Candidate& cause : model.adopted) {
    VectorXd d = whole_size(model, cause);
    // All other unknowns follow.
    std::vector<Eigen::Index> others;
    for (Eigen::Index i = 0; i < d.size(); ++i)
      if (d[i] == 0) others.push_back(i);
    const VectorXd pull = H * d;
    const VectorXd x = -inverse_of(H(others, others)) * pull(others);
    d(others) = x;
    const Told by_part = told(smoother, smoother.along(d), parts);
    const double all = d.dot(H * d);
    // What is left to go to the minimum, where a bent valley keeps a fit from it.
    double left = prior.gradient().dot(d);
    for (const std::vector<double>& of_part : by_part.score) left += sum_of(of_part);
    out.emplace_back();
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const std::vector<double>&score = by_part.score[p], &information = by_part.information[p];
      const double known = sum_of(information);
      if (!(known > kLeastShare * all)) continue;
      const double change = -sum_of(score) / known;
      double spread = 0;
      for (std::size_t b = 0; b < score.size(); ++b)
        spread += std::pow(score[b] + change * information[b], 2);
      out.back().push_back({parts[p].name, change + left / all, std::sqrt(spread) / known, known / all});
    }
  }
  return out;
}

}  // namespace ident
