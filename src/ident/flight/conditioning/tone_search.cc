// Power at the tones, against that some widths of a line beside them.
#include "ident/flight/conditioning/tone_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ident/core/parallel.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

using Eigen::Index;

constexpr int kOrders = 3;                // the balance of a propeller, and two or three blades that pass
constexpr double kToneBeyondDoubt = 6.0;  // standard deviations
constexpr double kLikely = 3.5;
// Times the power that commands make there, which may be that of motors of which nothing is known. A tone
// that went through a controller to the motors comes back with a hundredth of its size and less.
constexpr double kCommanded = 30.0;
constexpr double kPassedOn = 0.3;  // share of what commands make there that is more than beside it
constexpr std::size_t kFewestWindows = 10;
constexpr double kFarthest = 0.1;  // by which simulated speeds may be off

// Of each order, at `aside` Hz times seconds of the window from the tones, by each of them.
template <std::size_t Sides>
std::array<std::array<double, Sides>, kOrders> power_of(const TurningRotors& rotors, const ToneWindow& w,
                                                        const Eigen::MatrixXd& told, double scale,
                                                        const std::array<double, Sides>& asides) {
  const Eigen::ArrayXXcd turned = rotors.turned(w, scale);
  const Eigen::VectorXd sizes = rotors.sizes(w);
  const auto samples = static_cast<double>(w.y.rows());
  std::array<std::array<double, Sides>, kOrders> out{};
  Eigen::ArrayXcd aside(w.y.rows());
  for (std::size_t side = 0; side < Sides; ++side) {
    for (Index i = 0; i < aside.size(); ++i)
      aside[i] = std::polar(1.0, 2 * std::numbers::pi * asides[side] * static_cast<double>(i) / samples);
    for (Index n = 0; n < turned.cols(); ++n) {
      Eigen::ArrayXcd tone = aside;
      for (std::size_t k = 0; k < kOrders; ++k) {
        tone *= turned.col(n);
        const double power = (told.transpose() * tone.real().matrix()).squaredNorm() +
                             (told.transpose() * tone.imag().matrix()).squaredNorm();
        out[k][side] += sizes[n] * sizes[n] * power;
      }
    }
  }
  return out;
}

constexpr std::array kSides = {0.0, -4.0, -2.5, -1.5, 1.5, 2.5, 4.0};
using Powers = std::array<std::array<double, kSides.size()>, kOrders>;

// Power at the tones of an order in all windows, by how much that is more than beside them, and by how much
// chance scatters it.
struct Line {
  double there = 0.0, more = 0.0, chance = 0.0;
};

Line line_of(const std::vector<Powers>& windows, std::size_t order) {
  const double n = static_cast<double>(windows.size());
  std::array<double, kSides.size()> sums{};
  for (const Powers& window : windows)
    for (std::size_t side = 0; side < sums.size(); ++side) sums[side] += window[order][side];
  std::vector<double> squares;  // of each side
  for (std::size_t side = 1; side < sums.size(); ++side) {
    double& square = squares.emplace_back(0.0);
    for (const Powers& window : windows)
      square += std::pow(window[order][side] - sums[side] / n, 2) * n / (n - 1);
  }
  // Beside one tone there may be another: what is usual there counts.
  const double beside = median(std::vector<double>(sums.begin() + 1, sums.end()));
  return {sums[0], sums[0] - beside, std::sqrt(median(squares))};
}

}  // namespace

TonesFound tones_that_stand_out(const TurningRotors& rotors, const ToneWindows& sensor,
                                const std::vector<Eigen::MatrixXd>& commanded, double scale) {
  std::vector<Powers> found(sensor.windows.size()), by_commands(found.size());
  in_parallel(found.size(), [&](std::size_t i) {
    const ToneWindow& w = sensor.windows[i];
    found[i] = power_of(rotors, w, w.told, scale, kSides);
    if (commanded[i].size() == 0) return;
    Eigen::MatrixXd told(commanded[i].rows(), 3);
    for (Index axis = 0; axis < 3; ++axis) told.col(axis) = w.weighted(commanded[i].col(axis), axis);
    by_commands[i] = power_of(rotors, w, told, scale, kSides);
  });
  TonesFound out;
  if (found.size() < kFewestWindows) return out;
  for (std::size_t k = 0; k < kOrders; ++k) {
    const Line seen = line_of(found, k), told = line_of(by_commands, k);
    const double more = seen.more - kCommanded * told.there;
    const int order = static_cast<int>(k) + 1;
    if (more > kLikely * seen.chance) out.likely.push_back(order);
    if (!(more > kToneBeyondDoubt * seen.chance)) continue;
    out.beyond_doubt.push_back(order);
    out.passed_on |= told.more > std::max(kLikely * told.chance, kPassedOn * told.there);
  }
  return out;
}

double likeliest_scale(const TurningRotors& rotors, const std::vector<const ToneWindows*>& sensors) {
  const auto power = [&](double scale) {
    double sum = 0;
    for (const ToneWindows* sensor : sensors)
      for (const ToneWindow& w : sensor->windows)
        for (const auto& order : power_of<1>(rotors, w, w.told, scale, {0.0})) sum += order[0];
    return sum;
  };
  // Half the width of a line of twice the turns, then ever finer.
  double seconds = 0;
  for (const ToneWindows* sensor : sensors) seconds = std::max(seconds, sensor->seconds);
  double step = std::numbers::pi / (2 * seconds * rotors.usual()), best = 1.0, half = kFarthest;
  constexpr double kFinest = 3e-4, kFiner = 4;
  while (half > kFinest) {
    const auto each_side = std::max(1.0, std::round(half / step));
    step = half / each_side;
    std::vector<double> found(static_cast<std::size_t>(2 * each_side + 1));
    in_parallel(found.size(),
                [&](std::size_t i) { found[i] = power(best - half + static_cast<double>(i) * step); });
    const auto at = std::ranges::max_element(found) - found.begin();
    best += static_cast<double>(at) * step - half;
    if (half == kFarthest && (at == 0 || at + 1 == std::ssize(found))) return kNaN;
    half = step, step = half / kFiner;
  }
  return best;
}

}  // namespace ident
