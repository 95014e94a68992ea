// Chooses round ticks and labels for the axes of plots.
#include "ident/report/scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ident {
namespace {

/// The largest of 1, 2, 5 times a power of ten that gives at least `wanted` steps, more or less.
double round_step(double range, int wanted) {
  const double raw = range / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double mantissa = raw / power;
  return power * (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10);
}

std::string with_minus_sign(std::string number) {
  if (number.starts_with('-')) number.replace(0, 1, "−");
  return number;
}

/// Thousands' power to take out of labels, 0 where plain numbers read well.
int common_power(double largest) {
  if (largest == 0) return 0;
  const int power = static_cast<int>(std::floor(std::log10(largest)));
  return power >= 5 || power < -3 ? 3 * static_cast<int>(std::floor(power / 3.0)) : 0;
}

}  // namespace

Extent::Extent() : low(std::numeric_limits<double>::infinity()), high(-low) {}

void Extent::add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

std::string power_of_ten(int power) {
  constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = power < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(power))) out += kDigits[digit - '0'];
  return out;
}

Scale Scale::linear(Extent extent, int wanted, Padding padding) {
  Scale scale;
  if (extent.empty()) return scale;
  const double size = std::max(std::abs(extent.low), std::abs(extent.high));
  double range = extent.high - extent.low;
  if (range <= 1e-12 * size || range == 0) {
    range = size == 0 ? 1 : 0.1 * size;
    extent.low -= range / 2;
    extent.high = extent.low + range;
  }
  scale.low_ = extent.low - padding.low * range;
  scale.high_ = extent.high + padding.high * range;
  const double step = round_step(scale.high_ - scale.low_, wanted);
  const int power = common_power(std::max(std::abs(scale.low_), std::abs(scale.high_)));
  const double unit = std::pow(10.0, power);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step / unit) + 1e-9)));
  for (double i = std::ceil(scale.low_ / step - 1e-9); i * step <= scale.high_ + 1e-9 * step; ++i) {
    const double value = i == 0 ? 0 : i * step;
    scale.ticks_.push_back({value, with_minus_sign(fmt::format("{:.{}f}", value / unit, decimals))});
  }
  if (power != 0) scale.factor_ = "×" + power_of_ten(power);
  return scale;
}

Scale Scale::logarithmic(Extent extent) {
  Scale scale;
  scale.log_ = true;
  scale.low_ = extent.empty() ? 1 : extent.low;
  scale.high_ = extent.empty() ? 10 : extent.high;
  if (scale.high_ / scale.low_ < 1.5) scale.low_ /= 2, scale.high_ *= 2;
  const int first = static_cast<int>(std::floor(std::log10(scale.low_)));
  const int last = static_cast<int>(std::ceil(std::log10(scale.high_)));
  const int step = std::max(1, (last - first) / 7);
  const bool short_range = last - first <= 2;
  for (int power = first; power <= last; power += step)
    for (const int digit : {1, 2, 5}) {
      const double value = digit * std::pow(10.0, power);
      if (digit > 1 && !short_range) continue;
      if (value < scale.low_ * 0.999 || value > scale.high_ * 1.001) continue;
      const bool plain = first >= -3 && last <= 3;
      const std::string label = plain ? fmt::format("{:g}", value)
                                      : (digit > 1 ? fmt::format("{}·", digit) : "") + power_of_ten(power);
      scale.ticks_.push_back({value, label});
    }
  return scale;
}

Scale Scale::categories(const std::vector<std::string>& names) {
  Scale scale;
  scale.grid_ = false;
  scale.low_ = -0.5;
  scale.high_ = static_cast<double>(names.size()) - 0.5;
  for (std::size_t i = 0; i < names.size(); ++i) scale.ticks_.push_back({static_cast<double>(i), names[i]});
  return scale;
}

double Scale::position(double value) const {
  if (!log_) return (value - low_) / (high_ - low_);
  if (!(value > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::log(value / low_) / std::log(high_ / low_);
}

}  // namespace ident
