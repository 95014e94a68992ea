// std::from_chars with the decisions it leaves to us: a plus sign, overflow, underflow.
#include "ident/core/parse_number.h"

#include <charconv>
#include <limits>

namespace ident {
namespace {

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// from_chars says only "out of range": a negative exponent tells too small from too large. A mantissa as
/// long as 1e400 written out has no exponent and is too large; 0.000..1 with 400 zeros is too small.
double out_of_range(std::string_view text) {
  const std::size_t e = text.find_first_of("eE");
  const bool small_exponent = e != std::string_view::npos && e + 1 < text.size() && text[e + 1] == '-';
  const std::string_view digits = text.substr(text.front() == '-' ? 1 : 0);
  const bool small_mantissa = e == std::string_view::npos && (digits.front() == '0' || digits.front() == '.');
  const double size = small_exponent || small_mantissa ? 0.0 : std::numeric_limits<double>::infinity();
  return text.front() == '-' ? -size : size;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  text = without_blanks(text);
  const bool plus = text.size() > 1 && text.front() == '+' && text[1] != '-' && text[1] != '+';
  if (plus) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return out_of_range(text);
  if (error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace ident
