// Numbers and notes of the entries of a simulator's file.
#include "ident/io/simulators/value.h"

#include <fmt/format.h>

#include <cmath>

#include "ident/core/error.h"
#include "ident/core/parse_number.h"

namespace ident {
namespace {

constexpr double kNormal95 = 1.959963984540054;  // half width of a 95 % interval, in standard deviations

}  // namespace

std::string value_text(double number) {
  if (number == 0.0) return "0";  // no "-0"
  return fmt::format("{}", parse_number(fmt::format("{:.14e}", number)).value_or(number));
}

double as_stated(double number) {
  return number == 0.0 ? 0.0 : parse_number(fmt::format("{:.12e}", number)).value_or(number);
}

std::size_t Values::index(const std::string& name) const {
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (values_[i].name == name) return i;
  throw UsageError("the target has no entry '" + name + "'");
}

const Value& Values::at(const std::string& name) const { return values_[index(name)]; }

std::string Values::text(const std::string& name, const std::string& separator) const {
  const Value& value = at(name);
  if (!value.word.empty()) return value.word;
  std::string out;
  for (const double number : value.numbers) out += (out.empty() ? "" : separator) + value_text(number);
  return out;
}

std::pair<double, double> Values::interval(const std::string& name) const {
  const std::size_t i = index(name);
  const double half = i < deviations.size() ? kNormal95 * deviations[i] : 0.0,
               value = values_[i].numbers.front();
  return {value - half, value + half};
}

std::string Values::note(const std::string& name) const {
  const Value& value = at(name);
  const auto [low, high] = value.word.empty() ? interval(name) : std::pair(0.0, 0.0);
  std::string out = value.unit.empty() || value.unit == "-" ? "" : value.unit + "; ";
  if (high > low) out += fmt::format("95 % [{:.5g}, {:.5g}]; ", low, high);
  return out + value.of + (source.empty() ? "" : " of " + source);
}

}  // namespace ident
