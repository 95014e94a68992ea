// Thrust and power coefficients to thrust and torque, n in revolutions per second [Brandt, Selig: UIUC data
// base]:
//
//   T = CT rho n^2 D^4,   Q = CP rho n^2 D^5 / (2 pi)
#include "ident/io/csv/propeller_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <regex>

#include "ident/core/error.h"
#include "ident/core/parse_number.h"
#include "ident/io/csv/match_header.h"

namespace ident {
namespace {

using std::numbers::pi;

constexpr double kAirDensity = 1.225;    // kg/m^3: the files do not say theirs
constexpr double kInch = 0.0254;         // m
constexpr double kLargestInches = 40.0;  // above it the file's name means mm (vp_140x45)

struct Diameter {
  double metres = 0.0;
  std::string text;
};

Diameter diameter_from_name(const std::string& path) {
  static const std::regex pattern("_([0-9]+(\\.[0-9]+)?)[x_]");
  const std::string name = std::filesystem::path(path).filename().string();
  std::smatch match;
  if (!std::regex_search(name, match, pattern))
    throw InputError(
        path, 0, "",
        "holds CT and CP, but its name holds no diameter: name it like 'maker_8.5x6_static.txt' (inches)");
  const double size = parse_number(match[1].str()).value_or(0.0);
  const bool millimetres = size > kLargestInches;
  return {size * (millimetres ? 1e-3 : kInch),
          fmt::format("{} {}", match[1].str(), millimetres ? "mm" : "in")};
}

std::optional<std::size_t> column(const CsvReader& csv, const std::string& key) {
  const auto at = std::ranges::find(csv.header(), key, [](const std::string& h) { return header_key(h); });
  if (at == csv.header().end()) return std::nullopt;
  return static_cast<std::size_t>(at - csv.header().begin());
}

}  // namespace

std::optional<NumberTable> read_propeller_data(const std::string& path, CsvReader& csv) {
  const auto rpm = column(csv, "rpm"), ct = column(csv, "ct"), cp = column(csv, "cp");
  const bool plain_thrust = column(csv, "thrust").has_value();
  if (!rpm || !ct || !cp || plain_thrust) return std::nullopt;
  const Diameter diameter = diameter_from_name(path);
  const double D = diameter.metres;
  const double rad_per_s = 2.0 * pi / 60.0;
  NumberTable table = read_columns(path, csv,
                                   {{.name = "omega", .index = *rpm, .unit = rad_per_s},
                                    {.name = "thrust", .index = *ct},
                                    {.name = "torque", .index = *cp}},
                                   {});
  auto& omega = table.columns[0].values;
  auto& thrust = table.columns[1].values;
  auto& torque = table.columns[2].values;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const double n = omega[i] / (2.0 * pi);
    thrust[i] *= kAirDensity * n * n * D * D * D * D;
    torque[i] *= kAirDensity * n * n * D * D * D * D * D / (2.0 * pi);
  }
  table.notices.push_back(
      fmt::format("{}: CT and CP of a propeller of diameter {} (from the file's name), turned into "
                  "thrust and torque at {} kg/m^3",
                  path, diameter.text, kAirDensity));
  return table;
}

}  // namespace ident
