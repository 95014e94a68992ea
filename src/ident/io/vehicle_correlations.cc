// Correlations as a map of maps, each pair under the name that stands first.
#include "ident/io/vehicle_correlations.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "ident/core/nearest_word.h"
#include "ident/io/parameter_names.h"

namespace ident {
namespace {

using Eigen::Index;

// What rounding makes of an eigenvalue of 0.
constexpr double kRounding = 1e-9;

bool known_with_deviation(const Vehicle& vehicle, const std::string& name) {
  const auto at = vehicle.parameters.find(name);
  return at != vehicle.parameters.end() && std::isfinite(at->second.value) && at->second.std &&
         std::isfinite(*at->second.std) && *at->second.std > 0.0;
}

/// Place of a name among those of the correlation, which it joins.
Index place(const YamlValue& where, const std::string& name, const Vehicle& vehicle, Correlation& all) {
  const std::string inside = to_inside({name, {}, {}}, 0).name;
  if (!known_with_deviation(vehicle, inside)) {
    std::vector<std::string> known;
    for (const auto& [of_file, parameter] : vehicle.parameters)
      if (parameter.std) known.push_back(of_file);
    where.fail("is no parameter of this file with a standard deviation" + did_you_mean(name, known));
  }
  const auto at = std::ranges::find(all.names, inside);
  if (at != all.names.end()) return at - all.names.begin();
  all.names.push_back(inside);
  const Index n = all.matrix.rows();
  all.matrix.conservativeResize(n + 1, n + 1);
  all.matrix.row(n).setZero(), all.matrix.col(n).setZero();
  all.matrix(n, n) = 1.0;
  return n;
}

}  // namespace

Correlation read_correlations(const YamlValue& file, const Vehicle& vehicle) {
  Correlation all;
  if (!file.has("correlations")) return all;
  const YamlValue given = file.at("correlations");
  given.expect_map();
  for (const std::string& name : given.keys()) {
    const YamlValue others = given.at(name);
    others.expect_map();
    const Index a = place(others, name, vehicle, all);
    for (const std::string& other : others.keys()) {
      const YamlValue value = others.at(other);
      const double r = value.number();
      const Index b = place(value, other, vehicle, all);
      if (a == b) value.fail("is the correlation of a parameter with itself");
      if (!(std::abs(r) <= 1.0)) value.fail("has to be between -1 and 1");
      if (all.matrix(a, b) != 0.0) value.fail("is given twice: the other way round too");
      all.matrix(a, b) = all.matrix(b, a) = r;
    }
  }
  if (all.empty()) return all;
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(all.matrix).eigenvalues()[0];
  if (least < -kRounding) given.fail("cannot hold all at once: no quantities are correlated like this");
  return all;
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
                            in_file(known.names[static_cast<std::size_t>(k)]), known.matrix(i, k));
    if (!line.empty())
      out += fmt::format("  {}: {{{}}}\n", in_file(known.names[static_cast<std::size_t>(i)]), line);
  }
  return out.empty() ? out : "correlations:\n" + out;
}

}  // namespace ident
