// Correlations as a map of maps, each pair under the name that stands first.
#include "ident/io/vehicle/vehicle_correlations.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "ident/core/nearest_word.h"
#include "ident/io/vehicle/parameter_names.h"

namespace ident {
namespace {

using Eigen::Index;

// What rounding makes of an eigenvalue of 0.
constexpr double kRounding = 1e-9;
// Parameters that have a key of their own in a file.
const std::map<std::string, std::string> kOwnKeys = {{"mass", "m"}, {"arm", "l"}, {"slant_deg", "alpha"}};

bool known_with_deviation(const Vehicle& vehicle, const std::string& name) {
  const auto at = vehicle.parameters.find(name);
  return at != vehicle.parameters.end() && std::isfinite(at->second.value) && at->second.std &&
         std::isfinite(*at->second.std) && *at->second.std > 0.0;
}

/// The inside name of what a file calls so: keys of their own, and rotors that stand beside.
std::string inside_name(const std::string& name, const Vehicle& vehicle) {
  if (const auto key = kOwnKeys.find(name); key != kOwnKeys.end()) return key->second;
  if (vehicle.has(name) || !names_a_rotor(effect_of(name))) return to_inside({name, {}, {}}, 0).name;
  const auto numbered = [&](const auto& parameter) { return parameter.first.starts_with(name + "@"); };
  const auto at = std::ranges::find_if(vehicle.parameters, numbered);
  return at == vehicle.parameters.end() ? name : at->first;
}

/// Place of a name among those of the correlation, which it joins.
Index place(const std::string& inside, Correlation& all) {
  const auto at = std::ranges::find(all.names, inside);
  if (at != all.names.end()) return at - all.names.begin();
  all.names.push_back(inside);
  const Index n = all.matrix.rows();
  all.matrix.conservativeResize(n + 1, n + 1);
  all.matrix.row(n).setZero(), all.matrix.col(n).setZero();
  all.matrix(n, n) = 1.0;
  return n;
}

/// Whether the file states that with a standard deviation; said once where it does not.
bool is_stated(const YamlValue& where, const std::string& name, const std::string& inside, Vehicle& vehicle) {
  if (!is_file_parameter(name) && !kOwnKeys.contains(name))
    where.fail("'" + name + "' is no parameter of the model" + did_you_mean(name, file_parameter_names()));
  if (known_with_deviation(vehicle, inside)) return true;
  const std::string message = fmt::format(
      "{}: correlations: this file states no standard deviation of {}, so its correlations are ignored. "
      "State the standard deviation too.",
      vehicle.file, name);
  if (std::ranges::find(vehicle.warnings, message, &Warning::message) == vehicle.warnings.end())
    vehicle.warnings.push_back({"correlation_left_out", message});
  return false;
}

}  // namespace

void read_correlations(const YamlValue& file, Vehicle& vehicle) {
  if (!file.has("correlations")) return;
  const YamlValue given = file.at("correlations");
  Correlation all;
  std::set<std::set<std::string>> pairs;
  given.expect_map();
  for (const std::string& name : given.keys()) {
    const YamlValue others = given.at(name);
    others.expect_map();
    const std::string one = inside_name(name, vehicle);
    for (const std::string& other : others.keys()) {
      const YamlValue value = others.at(other);
      const double r = value.number();
      const std::string two = inside_name(other, vehicle);
      if (!(std::abs(r) <= 1.0)) value.fail("has to be between -1 and 1");
      if (one == two) value.fail("is the correlation of a parameter with itself");
      if (!pairs.insert({one, two}).second) value.fail("is given twice: the other way round too");
      if (!is_stated(others, name, one, vehicle) || !is_stated(value, other, two, vehicle)) continue;
      const Index a = place(one, all), b = place(two, all);
      all.matrix(a, b) = all.matrix(b, a) = r;
    }
  }
  if (all.empty()) return;
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(all.matrix).eigenvalues()[0];
  if (least < -kRounding)
    given.fail("cannot hold all at once: no quantities are correlated like this (rounded too far, perhaps)");
  vehicle.correlation = std::move(all);
}

std::string correlation_lines(const Vehicle& vehicle, const std::vector<std::string>& left_out) {
  const Correlation known = vehicle.correlation.part([&](const std::string& name) {
    return known_with_deviation(vehicle, name) && std::ranges::find(left_out, name) == left_out.end();
  });
  std::string out;
  for (Index i = 0; i < known.matrix.rows(); ++i) {
    std::string line;
    for (Index k = i + 1; k < known.matrix.rows(); ++k)
      if (known.matrix(i, k) != 0.0)
        line += fmt::format("{}{}: {}", line.empty() ? "" : ", ",
                            in_file(known.names[static_cast<std::size_t>(k)]),
                            std::clamp(known.matrix(i, k), -1.0, 1.0));
    if (!line.empty())
      out += fmt::format("  {}: {{{}}}\n", in_file(known.names[static_cast<std::size_t>(i)]), line);
  }
  return out.empty() ? out : "correlations:\n" + out;
}

}  // namespace ident
