// Noise levels by differences, states by interpolation and averages.
#include "ident/flight/record/initial_states.h"

#include <algorithm>
#include <cmath>

#include "ident/core/parallel.h"
#include "ident/core/statistics.h"
#include "ident/flight/record/motor_start.h"
#include "ident/flight/record/velocity_of_positions.h"

namespace ident {
namespace {

double filled(const std::vector<double>& column, std::size_t i, double otherwise) {
  return column.empty() || !std::isfinite(column[i]) ? otherwise : column[i];
}

// White noise by the median of second differences, which is robust against jumps. Not below the resolution of
// the sensor, which its smallest changes show.
double noise_of(const std::vector<double>& second_differences, std::vector<double> changes) {
  constexpr double kRepeats = 0.1;  // of the samples; without resolution no two are the same
  constexpr double kLeast = 0.05;   // share of the changes that are at most one step of the resolution
  if (second_differences.empty()) return kNaN;
  const double repeats = static_cast<double>(std::erase(changes, 0.0));
  const bool steps = repeats > kRepeats * (repeats + static_cast<double>(changes.size())) && !changes.empty();
  const double step = steps ? quantile(changes, kLeast) : 0.0;
  return std::max(1.4826 * median(second_differences) / std::sqrt(6.0), step / std::sqrt(12.0));
}

double noise_by_differences(const FlightRecord& record, int channel) {
  std::vector<double> size, changes;
  for (const FlightArc& arc : record.arcs) {
    double a = kNaN, b = kNaN;
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      const double y = arc.y[i * kChannels + static_cast<std::size_t>(channel)];
      if (!std::isfinite(y)) continue;
      if (std::isfinite(b)) changes.push_back(std::abs(y - b));
      if (std::isfinite(a)) size.push_back(std::abs(y - 2 * b + a));
      a = b, b = y;
    }
  }
  return noise_of(size, std::move(changes));
}

double attitude_noise(const FlightRecord& record, int axis) {
  std::vector<double> size, changes;
  for (const FlightArc& arc : record.arcs) {
    Eigen::Vector4d q1, q2;
    int have = 0;
    double turn1 = 0;
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      if (!std::isfinite(arc.y[i * kChannels + kAttitude])) continue;
      const Eigen::Vector4d q(arc.q[4 * i], arc.q[4 * i + 1], arc.q[4 * i + 2], arc.q[4 * i + 3]);
      if (have > 0) {
        const Vec4<double> d = quaternion_product(conjugate(q1), q);
        const double turn = 2 * d[1 + axis] * (d[0] < 0 ? -1 : 1);
        changes.push_back(std::abs(turn));
        if (have > 1) size.push_back(std::abs(turn - turn1));
        turn1 = turn;
      }
      q1 = q;
      ++have;
    }
  }
  return noise_of(size, std::move(changes));
}

// Means over the time that halves the noise at usual accelerations. Near the ground a height that is off by
// its noise may be one from which the simulation diverges.
std::vector<double> averaged(const std::vector<double>& t, const std::vector<double>& column, double noise) {
  constexpr double kAcceleration = 5.0, kLongestWalk = 0.05;  // m/s^2, s
  if (column.empty()) return column;
  const double reach = std::min(std::sqrt(3 * noise / kAcceleration), kLongestWalk);
  std::vector<double> out(column.size());
  for (std::size_t i = 0, begin = 0, end = 0; i < column.size(); ++i) {
    const auto within = [&](std::size_t k) { return std::abs(t[k] - t[i]) <= reach; };
    while (!within(begin)) ++begin;
    while (end < column.size() && (end < i || within(end))) ++end;
    const std::size_t n = std::min(i - begin, end - 1 - i);  // to either side
    double sum = 0;
    for (std::size_t k = i - n; k <= i + n; ++k) sum += column[k];
    out[i] = sum / static_cast<double>(2 * n + 1);
  }
  return out;
}

// Motor states by simulating the commands; measured speeds replace the simulated ones.
void simulate_motors(FlightArc& arc, const Vehicle& vehicle, std::span<const double> p) {
  const EffectSet<double> effects(p, active_effects(p));
  Flight<double, EffectSet<double>> flight(vehicle, p, effects, *arc.inputs);
  const std::size_t rotors = vehicle.rotors.size();
  std::array<MotorState<double>, kMaxRotors> motors = motors_at_start(flight, arc.t[0], rotors);
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    for (std::size_t n = 0; n < rotors; ++n) {
      const double y = arc.y[i * kChannels + kRotorChannel + n];
      if (std::isfinite(y) && y > 0) motors[n].Omega += 0.5 * (y - motors[n].Omega);
    }
    std::copy_n(motors.begin(), rotors, arc.motors.begin() + static_cast<std::ptrdiff_t>(i * rotors));
    if (i + 1 < arc.rows()) flight.advance(motors, arc.t[i], arc.t[i + 1] - arc.t[i]);
  }
}

std::vector<double> column_of(const FlightArc& arc, int channel) {
  std::vector<double> column(arc.rows());
  for (std::size_t i = 0; i < arc.rows(); ++i)
    column[i] = arc.y[i * kChannels + static_cast<std::size_t>(channel)];
  return column;
}

bool any_number(const std::vector<double>& column) {
  return std::ranges::any_of(column, [](double y) { return std::isfinite(y); });
}

// Measurements of the body of an arc, without gaps; empty columns where nothing was measured.
struct BodyColumns {
  std::array<std::vector<double>, 3> w, v, x;
  std::array<std::vector<double>, 4> q;
};

BodyColumns body_columns(const FlightArc& arc, const std::array<double, kChannels>& sigma) {
  BodyColumns of;
  in_parallel(13, [&](std::size_t c) {
    const std::size_t k = c % 3;
    const int axis = static_cast<int>(k);
    if (c < 3) {
      of.w[k] = filled_column(arc, kGyro + axis);
    } else if (c < 6) {
      of.v[k] = filled_column(arc, kVelocity + axis);
      if (const std::vector<double> x = column_of(arc, kPosition + axis); of.v[k].empty() && any_number(x))
        of.v[k] = velocity_of_positions(arc.t, x, sigma[kPosition + k]);
    } else if (c < 9) {
      of.x[k] = averaged(arc.t, filled_column(arc, kPosition + axis), sigma[kPosition + k]);
    } else {
      std::vector<double> q(arc.rows());
      for (std::size_t i = 0; i < q.size(); ++i) q[i] = arc.q[4 * i + (c - 9)];
      of.q[c - 9] = interpolated(arc.t, q);
    }
  });
  return of;
}

void set_body(FlightArc& arc, const BodyColumns& of, std::size_t i) {
  const auto& [w, v, x, q] = of;
  const std::size_t rows = arc.rows();
  BodyState<double>& b = arc.body[i];
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    b.w_B[at] = filled(w[k], i, 0.0);
    b.x_W[at] = filled(x[k], i, -10.0 * static_cast<double>(k == 2));
    b.v_W[at] = filled(v[k], i, 0.0);
  }
  for (std::size_t k = 0; k < 4; ++k)
    b.q_WB[static_cast<Eigen::Index>(k)] = filled(q[k], i, k == 0 ? 1.0 : 0.0);
  b.q_WB.normalize();
  if (w[0].empty() && !q[0].empty() && i + 1 < rows) {
    const Vec4<double> a(q[0][i], q[1][i], q[2][i], q[3][i]),
        e(q[0][i + 1], q[1][i + 1], q[2][i + 1], q[3][i + 1]);
    const Vec4<double> d = quaternion_product(conjugate(a), e);
    for (int k = 0; k < 3; ++k) b.w_B[k] = 2 * d[1 + k] * (d[0] < 0 ? -1 : 1) / (arc.t[i + 1] - arc.t[i]);
  }
}

}  // namespace

std::vector<double> interpolated(const std::vector<double>& t, const std::vector<double>& column) {
  std::vector<double> out = column;
  std::size_t last = column.size();
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (!std::isfinite(column[i])) continue;
    for (std::size_t k = last == column.size() ? 0 : last + 1; k < i; ++k) {
      out[k] = last == column.size()
                   ? column[i]
                   : column[last] + (t[k] - t[last]) / (t[i] - t[last]) * (column[i] - column[last]);
    }
    last = i;
  }
  if (last == column.size()) return {};
  for (std::size_t k = last + 1; k < column.size(); ++k) out[k] = column[last];
  return out;
}

std::vector<double> filled_column(const FlightArc& arc, int channel) {
  return interpolated(arc.t, column_of(arc, channel));
}

void set_noise_and_motor_start(FlightRecord& record, std::span<const double> p) {
  const std::size_t arcs = record.arcs.size();
  in_parallel(arcs + kChannels, [&](std::size_t i) {
    if (i < arcs) {
      FlightArc& arc = record.arcs[i];
      arc.body.resize(arc.rows()), arc.motors.resize(arc.rows() * record.vehicle->rotors.size());
      if (arc.inputs->commanded()) simulate_motors(arc, *record.vehicle, p);
      return;
    }
    const std::size_t c = i - arcs;
    const int channel = static_cast<int>(c);
    const bool turn = channel >= kAttitude && channel < kAttitude + 3;
    const double s =
        turn ? attitude_noise(record, channel - kAttitude) : noise_by_differences(record, channel);
    record.sigma[c] = std::isfinite(s) ? std::max(s, 1e-9) : 1.0;
  });
  // The axes of a sensor have similar levels: a quiet axis must not be trusted beyond its sensor.
  for (const int group : {int{kGyro}, int{kForce}, int{kAttitude}, int{kVelocity}, int{kPosition}}) {
    const auto g = static_cast<std::size_t>(group);
    const double top = std::max({record.sigma[g], record.sigma[g + 1], record.sigma[g + 2]});
    for (std::size_t k = 0; k < 3; ++k) record.sigma[g + k] = std::max(record.sigma[g + k], 0.2 * top);
  }
}

void set_body_start(FlightRecord& record) {
  constexpr std::size_t kBlock = 2000;  // rows
  in_parallel(record.arcs.size(), [&](std::size_t number) {
    FlightArc& arc = record.arcs[number];
    const BodyColumns of = body_columns(arc, record.sigma);
    in_parallel(arc.rows() / kBlock + 1, [&](std::size_t block) {
      const std::size_t end = std::min((block + 1) * kBlock, arc.rows());
      for (std::size_t i = block * kBlock; i < end; ++i) set_body(arc, of, i);
    });
  });
}

}  // namespace ident
