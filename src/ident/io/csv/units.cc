// The table of units.
#include "ident/io/csv/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>
#include <vector>

namespace ident {
namespace {

using std::numbers::pi;

constexpr double kGravity = 9.80665;      // m/s^2, standard
constexpr double kPound = 0.45359237;     // kg, avoirdupois
constexpr double kOunce = kPound / 16.0;  // kg
constexpr double kInchUnits = 0.0254;     // m
constexpr double kRpm = 2.0 * pi / 60.0;  // rad/s
constexpr double kDegree = pi / 180.0;    // rad

/// One unit under all its plain spellings (see `plain`); the first one is shown in messages.
struct Entry {
  Dimension dimension;
  double scale;
  std::vector<std::string> spellings;
};

const std::vector<Entry>& entries() {
  using enum Dimension;
  static const std::vector<Entry> table = {
      {number, 1.0, {"-", "1"}},
      {time, 1.0, {"s", "sec", "secs", "second", "seconds"}},
      {time, 1e-3, {"ms", "msec", "millisecond", "milliseconds"}},
      {time, 1e-6, {"us", "usec", "microsecond", "microseconds"}},
      {time, 1e-9, {"ns", "nsec", "nanoseconds"}},
      {time, 60.0, {"min"}},
      {length, 1.0, {"m", "meter", "metre", "meters", "metres"}},
      {length, 1e-2, {"cm"}},
      {length, 1e-3, {"mm"}},
      {length, kInchUnits, {"in", "inch", "inches"}},
      {length, 12.0 * kInchUnits, {"ft"}},
      {mass, 1.0, {"kg"}},
      {mass, 1e-3, {"g", "gram", "grams"}},
      {mass, kPound, {"lb", "lbs"}},
      {mass, kOunce, {"oz"}},
      {velocity, 1.0, {"m/s", "ms-1"}},
      {velocity, 1e-2, {"cm/s"}},
      {velocity, 1e-3, {"mm/s"}},
      {velocity, 1.0 / 3.6, {"km/h", "kph"}},
      {velocity, 12.0 * kInchUnits, {"ft/s"}},
      {acceleration, 1.0, {"m/s2", "m/s/s", "ms-2"}},
      {acceleration, kGravity, {"g", "g0", "gn"}},
      {acceleration, 1e-3 * kGravity, {"mg"}},
      {acceleration, 12.0 * kInchUnits, {"ft/s2"}},
      {angle, 1.0, {"rad", "radian", "radians"}},
      {angle, kDegree, {"deg", "degree", "degrees"}},
      {angle, 1e-2 * kDegree, {"cdeg", "centideg"}},
      {angle, 1e-3, {"mrad"}},
      {angular_rate, 1.0, {"rad/s", "rad/sec", "rads-1", "1/s"}},
      {angular_rate, kDegree, {"deg/s", "deg/sec", "dps", "degs-1"}},
      {angular_rate, 1e-3, {"mrad/s"}},
      {angular_rate, kRpm, {"rpm", "r/min", "rev/min", "1/min", "min-1"}},
      {angular_rate, 1e3 * kRpm, {"krpm"}},
      {angular_rate, 2.0 * pi, {"rev/s", "rps", "hz", "r/s"}},
      {force, 1.0, {"N", "n", "newton", "newtons"}},
      {force, 1e-3, {"mN"}},
      {force, 1e3, {"kN"}},
      {force, 1e-3 * kGravity, {"gf", "g", "gram-force", "pond"}},
      {force, kGravity, {"kgf", "kg", "kp"}},
      {force, kPound * kGravity, {"lbf", "lb", "lbs"}},
      {force, kOunce * kGravity, {"ozf", "oz"}},
      {torque, 1.0, {"N·m", "nm", "n-m"}},
      {torque, 1e-3, {"mN·m", "mNm", "N·mm", "nmm"}},
      {torque, 1e-6, {"uN·m", "unm"}},
      {torque, 1e-2, {"N·cm", "ncm"}},
      {torque, 1e-5 * kGravity, {"gf·cm", "gfcm", "gcm", "g-cm", "gf-cm"}},
      {torque, 1e-6 * kGravity, {"gf·mm", "gfmm", "gmm"}},
      {torque, 1e-3 * kGravity, {"gf·m", "gfm", "gm"}},
      {torque, 1e-2 * kGravity, {"kgf·cm", "kgfcm", "kgcm", "kg-cm", "kgf-cm"}},
      {torque, kGravity, {"kgf·m", "kgfm", "kgm", "kgf-m"}},
      {torque,
       kOunce * kGravity * kInchUnits,
       {"oz·in", "ozin", "ozfin", "oz-in", "ozf-in", "inoz", "in-oz"}},
      {torque,
       kPound * kGravity * kInchUnits,
       {"lbf·in", "lbfin", "lbin", "lbf-in", "lb-in", "inlb", "in-lb", "inlbf"}},
      {torque,
       12.0 * kPound * kGravity * kInchUnits,
       {"lbf·ft", "lbfft", "lbft", "lbf-ft", "lb-ft", "ftlb", "ft-lb", "ftlbf"}},
      {voltage, 1.0, {"V", "v", "volt", "volts"}},
      {voltage, 1e-3, {"mV"}},
      {current, 1.0, {"A", "a", "amp", "amps", "ampere"}},
      {current, 1e-3, {"mA"}},
      {fraction, 1.0, {"-", "1"}},
      {fraction, 1e-2, {"%", "percent", "pct"}},
      {pulse_width, 1.0, {"us", "usec", "microseconds"}},
      {pulse_width, 1e3, {"ms"}},
      {pulse_width, 1e6, {"s"}},
  };
  return table;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// Typographic variants made alike: micro sign and Greek mu, multiplication dots, superscripts, degree sign.
std::string plain(std::string_view spelling) {
  std::string text(spelling);
  for (const char* mu : {"\u00B5", "\u03BC"}) replace_all(text, mu, "u");
  for (const char* dot :
       {"\u00B7", "\u22C5", "\u2219", "\u2022", "\u00D7", "*", ".", " ", "_", "^", "\u00A0"})
    replace_all(text, dot, "");
  replace_all(text, "\u00B2", "2");
  replace_all(text, "\u207B\u00B9", "-1");
  replace_all(text, "\u207B2", "-2");
  replace_all(text, "\u2212", "-");
  for (const char* degree : {"\u00B0", "\u00BA"}) replace_all(text, degree, "deg");
  return text;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Case counts only in spellings that have capitals: `RPM` is rpm, but `MN` is not mN.
bool matches(const std::string& written, const std::string& spelling) {
  const std::string known = plain(spelling);
  return written == known || (known == lower(known) && lower(written) == known);
}

std::string_view without_blanks(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// As programs write the elements of a vector: gyro_rad[0].
bool is_index(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::optional<double> unit_factor(std::string_view spelling, Dimension dimension) {
  const std::string written = plain(spelling);
  if (written.empty()) return std::nullopt;
  for (const Entry& entry : entries())
    if (entry.dimension == dimension &&
        std::ranges::any_of(entry.spellings, [&](const std::string& s) { return matches(written, s); }))
      return entry.scale;
  return std::nullopt;
}

std::string known_units(Dimension dimension) {
  std::string list;
  for (const Entry& entry : entries())
    if (entry.dimension == dimension) list += (list.empty() ? "" : ", ") + entry.spellings.front();
  return list;
}

HeaderName split_header(std::string_view header) {
  header = without_blanks(header);
  for (const auto& [open, close] : {std::pair('[', ']'), std::pair('(', ')')}) {
    if (header.empty() || header.back() != close) continue;
    const std::size_t at = header.rfind(open);
    if (at == std::string_view::npos) continue;
    const std::string_view unit = without_blanks(header.substr(at + 1, header.size() - at - 2));
    if (open == '[' && is_index(unit) && at > 0 && header[at - 1] != ' ') continue;
    HeaderName name{std::string(without_blanks(header.substr(0, at))), std::nullopt};
    if (!unit.empty()) name.unit = std::string(unit);
    return name;
  }
  return {std::string(header), std::nullopt};
}

}  // namespace ident
