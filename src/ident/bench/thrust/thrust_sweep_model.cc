// Unknowns, residuals and derivatives of a sweep.
#include "ident/bench/thrust/thrust_sweep_model.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr std::size_t kFewestRepeats = 6;  // readings beyond one a set-point
constexpr std::size_t kFewestSetPoints = 3;
constexpr double kNegligible = 0.005;       // share of a force's variance that comes from the speed's scatter
constexpr std::size_t kFewestForNoise = 5;  // readings at rest that know their own noise

using Repeats = std::map<int, std::vector<const SweepPoint*>>;

Repeats repeats_of(const SweepChannel& channel) {
  Repeats repeats;
  for (const SweepPoint& p : channel.moving)
    if (p.set_point >= 0) repeats[p.set_point].push_back(&p);
  return repeats;
}

/// Pooled scatter within set-points, of the speed and of the force less what the mean speed explains.
struct Scatter {
  double speed = 0.0, force = 0.0, speed_in_force = 0.0;
};
Scatter scatter_within(const SweepChannel& channel) {
  std::vector<double> speed, force, effect;
  for (const auto& [set_point, points] : repeats_of(channel)) {
    if (points.size() < 2) continue;
    std::vector<double> w, y;
    for (const SweepPoint* p : points) w.push_back(p->Omega), y.push_back(p->value);
    const double grow = std::sqrt(static_cast<double>(w.size()) / static_cast<double>(w.size() - 1));
    const double w0 = median(w), y0 = median(y);
    for (std::size_t i = 0; i < w.size(); ++i) {
      speed.push_back(grow * (w[i] - w0));
      force.push_back(grow * (y[i] - y0));
      effect.push_back(2.0 * channel.start_constant * w0 * speed.back());
    }
  }
  return {root_mean_square(speed), root_mean_square(force), root_mean_square(effect)};
}

}  // namespace

bool speed_scatter_matters(const SweepPoints& points) {
  if (points.averaged) return false;
  const Repeats repeats = repeats_of(points.thrust);
  std::size_t more = 0;
  for (const auto& [set_point, list] : repeats) more += list.size() - 1;
  if (more < kFewestRepeats || repeats.size() < kFewestSetPoints) return false;
  const auto matters = [](const SweepChannel& channel) {
    if (channel.moving.empty()) return false;
    const Scatter within = scatter_within(channel);
    return square(within.speed_in_force) > kNegligible * square(within.force);
  };
  return matters(points.thrust) || matters(points.torque);
}

SweepModel::SweepModel(const SweepPoints& points, ThrustLaw law, RestNoise rest_noise) {
  if (speed_scatter_matters(points)) add_set_points(points);
  add_channel(points.thrust, "kT", law == ThrustLaw::with_linear_term);
  if (points.has_torque()) add_channel(points.torque, "kQ", law == ThrustLaw::with_linear_term);
  add_groups(points, rest_noise);
  problem_.evaluate = [this](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    return evaluate(x, r, J);
  };
}

int SweepModel::add_unknown(std::string name, double start, Coordinate coordinate) {
  problem_.unknowns.push_back({std::move(name), start, coordinate});
  return static_cast<int>(problem_.unknowns.size()) - 1;
}

void SweepModel::add_set_points(const SweepPoints& points) {
  std::map<double, const SweepPoint*> by_row;  // thrust and torque of a row share its reading of the speed
  for (const SweepChannel* channel : {&points.thrust, &points.torque})
    for (const SweepPoint& p : channel->moving) by_row[p.place] = &p;
  std::map<int, std::vector<double>> speeds;
  for (const auto& [row, p] : by_row) speeds[p->set_point].push_back(p->Omega);
  share_ = add_unknown("speed_share", 0.5, Coordinate::real);
  first_speed_ = static_cast<int>(problem_.unknowns.size());
  std::map<int, int> place;
  for (const auto& [set_point, list] : speeds) {
    place[set_point] = static_cast<int>(set_points_.size());
    set_points_.push_back(set_point);
    add_unknown("Omega_" + std::to_string(set_point), median(list), Coordinate::positive);
  }
  for (const auto& [row, p] : by_row) readings_.push_back({p->Omega, place.at(p->set_point)});
}

void SweepModel::add_channel(const SweepChannel& from, const char* constant, bool law_with_linear_term) {
  const double scale = from.full_scale(), top = std::ranges::max(from.moving, {}, &SweepPoint::Omega).Omega;
  Channel channel{.constant = add_unknown(constant, std::max(from.start_constant, 1e-6 * scale / square(top)),
                                          Coordinate::positive),
                  .tare = add_unknown(from.name + "_tare", from.start_tare, Coordinate::real),
                  .offset = -1,
                  .slope = -1};
  if (law_with_linear_term) {
    if (!from.rest.empty()) channel.offset = add_unknown(from.name + "_offset", 0.0, Coordinate::real);
    channel.slope = add_unknown(from.name + "_slope", 0.0, Coordinate::real);
  }
  for (const SweepPoint& p : from.moving) {
    const auto at = std::ranges::find(set_points_, p.set_point);
    channel.rows.push_back(
        {p.Omega, p.value, at == set_points_.end() ? -1 : static_cast<int>(at - set_points_.begin())});
  }
  channel.rest = std::isfinite(from.rest_std) ? std::vector<double>{from.rest_mean} : from.rest;
  channels_.push_back(std::move(channel));
}

int SweepModel::add_group(NoiseGroup group) {
  problem_.groups.push_back(std::move(group));
  return static_cast<int>(problem_.groups.size()) - 1;
}

ResidualSeries SweepModel::add_series(Eigen::Index rows, int group) {
  const ResidualSeries made{.begin = problem_.residuals, .end = problem_.residuals + rows, .group = group};
  problem_.residuals = made.end;
  if (rows > 0) problem_.series.push_back(made);
  return made;
}

/// Rows of one group are one series in the order of the file, so that noise that lasts from rest into motion
/// is seen as one.
void SweepModel::add_residuals(const SweepChannel& from, Channel& channel, int moving_group, int rest_group) {
  const auto count = [](const auto& list) { return static_cast<Eigen::Index>(list.size()); };
  channel.group = static_cast<std::size_t>(moving_group);
  const bool together = moving_group == rest_group && channel.rest.size() == from.rest_place.size();
  Eigen::Index at = problem_.residuals;
  add_series(count(channel.rows) + (together ? count(channel.rest) : 0), moving_group);
  std::size_t moving = 0, rest = 0;
  while (moving < channel.rows.size() || (together && rest < channel.rest.size())) {
    const bool is_rest = together && rest < channel.rest.size() &&
                         (moving == channel.rows.size() || from.rest_place[rest] < from.moving[moving].place);
    (is_rest ? channel.at_rest : channel.moving).push_back(at++);
    ++(is_rest ? rest : moving);
  }
  if (together) return;
  const ResidualSeries own = add_series(count(channel.rest), rest_group);
  for (Eigen::Index i = own.begin; i < own.end; ++i) channel.at_rest.push_back(i);
}

void SweepModel::add_groups(const SweepPoints& points, RestNoise rest_noise) {
  if (!readings_.empty())
    speeds_ = add_series(static_cast<Eigen::Index>(readings_.size()), add_group({.name = "speed"}));
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const SweepChannel& from = c == 0 ? points.thrust : points.torque;
    const int moving = add_group({.name = from.name, .in_time_order = !points.averaged});
    int rest = moving;
    if (std::isfinite(from.rest_std))
      rest = add_group({.name = from.name + " at rest",
                        .known_sigma = std::max(from.rest_std, 1e-6 * from.full_scale()),
                        .in_time_order = false,
                        .may_have_outliers = false});
    else if (rest_noise == RestNoise::own && channels_[c].rest.size() >= kFewestForNoise)
      rest = add_group({.name = from.name + " at rest"});
    add_residuals(from, channels_[c], moving, rest);
  }
}

void SweepModel::evaluate_row(const Channel& channel, const Row& row, Eigen::Index at,
                              const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const {
  const double k = x(channel.constant), b = channel.slope < 0 ? 0.0 : x(channel.slope);
  double speed = row.w;
  if (row.set_point >= 0) {
    const double Omega = x(first_speed_ + row.set_point);
    speed = Omega + x(share_) * (row.w - Omega);  // (2)
  }
  const double offset = channel.offset < 0 ? 0.0 : x(channel.offset);
  r(at) = x(channel.tare) + offset + b * speed + k * square(speed) - row.value;  // (1), (3)
  if (!J) return;
  (*J)(at, channel.constant) = square(speed);
  (*J)(at, channel.tare) = 1.0;
  if (channel.offset >= 0) (*J)(at, channel.offset) = 1.0;
  if (channel.slope >= 0) (*J)(at, channel.slope) = speed;
  if (row.set_point < 0) return;
  const double along = 2.0 * k * speed + b;
  (*J)(at, first_speed_ + row.set_point) = along * (1.0 - x(share_));
  (*J)(at, share_) = along * (row.w - x(first_speed_ + row.set_point));
}

bool SweepModel::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const {
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    const Eigen::Index at = speeds_.begin + static_cast<Eigen::Index>(i),
                       place = first_speed_ + readings_[i].set_point;
    r(at) = x(place) - readings_[i].w;
    if (J) (*J)(at, place) = 1.0;
  }
  for (const Channel& channel : channels_) {
    for (std::size_t i = 0; i < channel.rows.size(); ++i)
      evaluate_row(channel, channel.rows[i], channel.moving[i], x, r, J);
    for (std::size_t i = 0; i < channel.rest.size(); ++i) {
      const Eigen::Index at = channel.at_rest[i];
      r(at) = x(channel.tare) - channel.rest[i];
      if (J) (*J)(at, channel.tare) = 1.0;
    }
  }
  return true;
}

}  // namespace ident
