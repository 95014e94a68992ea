// Rounds numbers to their uncertainty; fmt ignores the locale, so the decimal mark is always a point.
#include "ident/core/format_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace ident {
namespace {

constexpr const char* kMissing = "–";
constexpr double kFinest = 1e-9;    // of the value: what a fit says beyond that is rounding of its data
constexpr double kNothing = 1e-30;  // smaller than anything that is measured here, in whatever unit

/// Power of ten of the leading digit after rounding to `digits` significant digits.
int leading_power(double x, int digits) {
  const std::string text = fmt::format("{:.{}e}", std::abs(x), digits - 1);
  return std::atoi(text.c_str() + text.find('e') + 1);
}

bool usable(double std) { return std::isfinite(std) && std > 0; }

bool is_nothing(double value, double std) { return std::abs(value) < kNothing && std < kNothing; }

bool wants_power(int power) { return power < -3 || power > 4; }

/// The rule by which value, deviation and interval of one estimate are written alike.
struct Rounding {
  int power = 0;     ///< taken out of all numbers; 0 for none
  int decimals = 0;  ///< of what remains

  Rounding(double value, double std) {
    std = std::max(std, kFinest * std::abs(value));
    const int last = leading_power(std, 2) - 1;
    const int digits = value == 0 ? 1 : std::max(1, leading_power(value, 17) - last + 1);
    const int lead = value == 0 ? last + 1 : std::max(leading_power(value, digits), last + 1);
    power = wants_power(lead) ? lead : 0;
    decimals = std::max(0, power - last);
  }

  std::string write(double x) const {
    if (!std::isfinite(x)) return kMissing;
    const std::string text = fmt::format("{:.{}f}", x / std::pow(10.0, power), decimals);
    const bool only_zeros = text.find_first_of("123456789") == std::string::npos;
    return only_zeros && text.front() == '-' ? text.substr(1) : text;
  }

  std::string suffix() const { return power == 0 ? "" : fmt::format("e{}", power); }
};

}  // namespace

std::string format_with_uncertainty(double value, double std) {
  if (!std::isfinite(value) || !usable(std)) return format_number(value);
  if (is_nothing(value, std)) return "0";
  const Rounding rounding(value, std);
  const std::string pair =
      rounding.write(value) + " ± " + rounding.write(std::max(std, kFinest * std::abs(value)));
  return rounding.power == 0 ? pair : "(" + pair + ")" + rounding.suffix();
}

std::string format_rounded(double value, double std) {
  if (!std::isfinite(value) || !usable(std)) return format_number(value);
  if (is_nothing(value, std)) return "0";
  const Rounding rounding(value, std);
  return rounding.write(value) + rounding.suffix();
}

std::string format_interval(const std::array<double, 2>& interval, double value, double std) {
  if (!std::isfinite(interval[0]) && !std::isfinite(interval[1])) return kMissing;
  if (!std::isfinite(value) || !usable(std) || is_nothing(value, std))
    return "[" + format_number(interval[0]) + ", " + format_number(interval[1]) + "]";
  const Rounding rounding(value, std);
  return "[" + rounding.write(interval[0]) + ", " + rounding.write(interval[1]) + "]" + rounding.suffix();
}

std::string format_number(double value, int digits) {
  if (!std::isfinite(value)) return kMissing;
  if (std::abs(value) < kNothing) return "0";
  const int power = leading_power(value, digits);
  const bool scientific = wants_power(power);
  const int decimals = scientific ? digits - 1 : std::max(0, digits - 1 - power);
  std::string text = fmt::format("{:.{}f}", scientific ? value / std::pow(10.0, power) : value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return scientific ? text + fmt::format("e{}", power) : text;
}

}  // namespace ident
