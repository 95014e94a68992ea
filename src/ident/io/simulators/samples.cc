// x = mean + S L z with z normal; L L' is the correlation, from its eigenvalues so that a singular one serves
// too.
#include "ident/io/simulators/samples.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/random.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/io/simulators/reduced.h"
#include "ident/io/simulators/simulators.h"

namespace ident {
namespace {

constexpr int kMostTries =
    1000;  // draws for one sample: a body is found at once unless nothing is known of J

struct Drawn {
  std::string name;
  double value, std;
  bool logarithmic;
};

bool positive_by_nature(const std::string& name, double value) {
  if (!(value > 0)) return false;
  if (name == "Jxx" || name == "Jyy" || name == "Jzz") return true;
  if (const EffectParameter* parameter = find_effect_parameter(name))
    return parameter->range == Range::positive;
  const ParameterInfo* info = find_parameter(name);
  return info && info->kind == ParameterKind::positive;
}

std::vector<Drawn> uncertain(const Vehicle& vehicle) {
  std::vector<Drawn> list;
  for (const auto& [name, known] : vehicle.parameters)
    if (known.std && *known.std > 0 && std::isfinite(*known.std))
      list.push_back({name, known.value, *known.std, positive_by_nature(name, known.value)});
  return list;
}

Eigen::MatrixXd factor(const Vehicle& vehicle, const std::vector<Drawn>& list) {
  const Eigen::Index n = static_cast<Eigen::Index>(list.size());
  Eigen::MatrixXd correlation(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      correlation(i, k) = vehicle.correlation.of(list[static_cast<std::size_t>(i)].name,
                                                 list[static_cast<std::size_t>(k)].name);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(correlation);
  return solved.eigenvectors() * solved.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

/// Whether a body can have this inertia: positive definite, and no principal moment above the sum of the
/// others.
bool is_body(const Vehicle& vehicle) {
  const Eigen::Vector3d J =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mass_properties(vehicle).J, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return J[0] > 0 && J[2] <= J[0] + J[1];
}

}  // namespace

std::vector<Vehicle> sampled_vehicles(const Vehicle& vehicle, std::size_t count, std::uint64_t seed) {
  const std::vector<Drawn> list = uncertain(vehicle);
  if (list.empty())
    throw DataError((vehicle.file.empty() ? "the vehicle" : vehicle.file) +
                    " states no standard deviation: there is nothing to draw from");
  const Eigen::MatrixXd L = factor(vehicle, list);
  const bool inertia_drawn = is_body(vehicle);  // a file that states no body is not made one
  Random random(seed);
  std::vector<Vehicle> out;
  while (out.size() < count) {
    Vehicle drawn = vehicle;
    int tries = 0;
    do {
      if (++tries > kMostTries)
        throw DataError("of 1000 draws none is the inertia of a body: its standard deviations are too large");
      Eigen::VectorXd z(static_cast<Eigen::Index>(list.size()));
      for (double& one : z) one = random.normal();
      const Eigen::VectorXd x = L * z;
      for (std::size_t i = 0; i < list.size(); ++i) {
        const double step = x[static_cast<Eigen::Index>(i)] * list[i].std;
        drawn.parameters[list[i].name].value =
            list[i].logarithmic ? list[i].value * std::exp(step / list[i].value) : list[i].value + step;
      }
    } while (inertia_drawn && !is_body(drawn));
    out.push_back(std::move(drawn));
  }
  return out;
}

std::string samples_csv(const SimulatorFormat& format, const std::vector<Vehicle>& vehicles,
                        std::uint64_t seed) {
  std::string out = fmt::format("# {} sets of the values of {}, drawn by ident, seed {}\n", vehicles.size(),
                                format.target, seed);
  for (std::size_t row = 0; row < vehicles.size(); ++row) {
    std::string header, line;
    for (const Value& value : format.values(held_by(format, vehicles[row]), nullptr))
      for (std::size_t i = 0; i < value.numbers.size(); ++i) {
        if (row == 0)
          header += (header.empty() ? "" : ",") + value.name +
                    (value.numbers.size() > 1 ? fmt::format("[{}]", i + 1) : "");
        line += (line.empty() ? "" : ",") + value_text(value.numbers[i]);
      }
    if (row == 0) out += header + "\n";
    out += line + "\n";
  }
  return out;
}

}  // namespace ident
