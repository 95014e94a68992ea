// Every so many samples, by how alike neighbours are.
#include "ident/flight/conditioning/decimate_filtered.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ident {
namespace {

// Roughness of noise that is white, and of noise that is nearly, where motion is fast as well.
constexpr double kWhite = -0.74, kNearly = -0.5;
constexpr double kLongest = 0.016;   // s between samples that are left: motion must not be lost
constexpr std::size_t kFew = 300;    // pairs of differences that tell
constexpr std::size_t kMany = 3000;  // and more of them tell no more
constexpr double kEven = 1.5;        // times the usual interval between neighbours; longer ones are gaps

using Sensor = std::array<std::vector<double>, 3>;

// Rows in which all components were sampled.
std::vector<std::size_t> sampled_rows(const Sensor& sensor) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < sensor[0].size(); ++i)
    if (std::isfinite(sensor[0][i]) && std::isfinite(sensor[1][i]) && std::isfinite(sensor[2][i]))
      rows.push_back(i);
  return rows;
}

double usual_interval(const std::vector<double>& t, const std::vector<std::size_t>& rows) {
  return (t[rows.back()] - t[rows.front()]) / static_cast<double>(rows.size() - 1);
}

// The correlation, and how far chance takes it.
struct Rough {
  double correlation = kNaN, std = kNaN;
};

Rough roughness_of(const std::vector<double>& t, const Sensor& sensor, const std::vector<std::size_t>& rows,
                   std::size_t stride) {
  constexpr std::array weights = {1.0, -4.0, 6.0, -4.0, 1.0};
  const std::size_t reach = weights.size() * stride;
  if (rows.size() < reach + kFew) return {};
  const double longest = kEven * static_cast<double>(reach) * usual_interval(t, rows);
  const std::size_t step = std::max<std::size_t>(1, rows.size() / kMany);
  double same = 0, count = 0;
  for (std::size_t i = 0; i + reach < rows.size(); i += step) {
    if (t[rows[i + reach]] - t[rows[i]] > longest) continue;
    for (const std::vector<double>& y : sensor) {
      double here = 0, next = 0;
      for (std::size_t k = 0; k < weights.size(); ++k) {
        here += weights[k] * y[rows[i + k * stride]];
        next += weights[k] * y[rows[i + (k + 1) * stride]];
      }
      if (here == 0 || next == 0) continue;  // samples that were rounded
      same += (here > 0) == (next > 0), count += 1;
    }
  }
  if (count < static_cast<double>(kFew)) return {};
  // Of two Gaussian numbers, from how often their signs agree.
  return {std::sin(std::numbers::pi * (same / count - 0.5)), 1 / std::sqrt(count)};
}

}  // namespace

double roughness(const std::vector<double>& t, const Sensor& sensor, std::size_t stride) {
  const std::vector<std::size_t> rows = sampled_rows(sensor);
  return rows.size() < 2 ? kNaN : roughness_of(t, sensor, rows, stride).correlation;
}

std::size_t white_stride(const std::vector<double>& t, const Sensor& sensor) {
  const std::vector<std::size_t> rows = sampled_rows(sensor);
  if (rows.size() < kFew) return 1;
  const auto most = static_cast<std::size_t>(kLongest / usual_interval(t, rows));
  double least = kNearly;
  std::size_t best = 1;
  for (std::size_t stride = 1; stride <= most; ++stride) {
    const auto [rough, std] = roughness_of(t, sensor, rows, stride);
    if (rough < kWhite + 2 * std) return stride;
    if (rough < least) least = rough, best = stride;
  }
  return best;
}

std::vector<FlightLog> whitened_sensors(std::span<const FlightLog> logs, std::vector<Warning>& warnings) {
  struct Imu {
    Sensor FlightLog::*sensor;
    const char* name;
    std::vector<std::size_t> rows{};
    double interval = kNaN;
    std::size_t own = 1, stride = 1;  // that makes its noise white, and that is taken
  };
  std::vector<FlightLog> out;
  for (std::size_t n = 0; n < logs.size(); ++n) {
    std::array<Imu, 2> imu = {{{&FlightLog::w_B, "p q r"}, {&FlightLog::f_B, "ax ay az"}}};
    double longest = 0;  // s between samples that are left
    for (Imu& one : imu) {
      const Sensor& sensor = logs[n].*one.sensor;
      if (!sensor[0].empty()) one.rows = sampled_rows(sensor);
      if (one.rows.size() < 2) continue;
      one.interval = usual_interval(logs[n].t, one.rows);
      one.own = one.stride = white_stride(logs[n].t, sensor);
      if (one.own > 1) longest = std::max(longest, static_cast<double>(one.own) * one.interval);
    }
    for (Imu& one : imu) {
      if (!logs[n].has_attitude() && longest > kEven * one.interval)
        one.stride = static_cast<std::size_t>(std::lround(longest / one.interval));
      if (one.stride == 1) continue;
      if (out.empty()) out.assign(logs.begin(), logs.end());
      for (std::size_t k = 0; k < one.rows.size(); ++k)
        if (k % one.stride != 0)
          for (std::vector<double>& c : out[n].*one.sensor) c[one.rows[k]] = kNaN;
      warnings.push_back(
          {"filtered_noise",
           fmt::format("{}: {}: {}. One sample in {} is used, {:.0f} a second, so that intervals stay right. "
                       "Log the sensors before the filters.",
                       logs[n].file, one.name,
                       one.own == one.stride
                           ? "neighbouring samples share their noise, as after a filter"
                           : "as few samples as of the other sensor, whose neighbours share their noise",
                       one.stride, 1 / (static_cast<double>(one.stride) * one.interval))});
    }
  }
  return out;
}

}  // namespace ident
