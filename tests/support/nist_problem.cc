// Reader and models of the NIST StRD collection.
#include "support/nist_problem.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

#include "ident/lsq/least_squares_autodiff.h"

namespace ident::nist {
namespace {

using Jet = ceres::Jet<double, 4>;

/// One model for both scalars: f(b, row), row = (y, x, ...), gives the predicted y.
struct Model {
  std::function<double(const double*, const std::vector<double>&)> plain;
  std::function<Jet(const Jet*, const std::vector<double>&)> jet;
};

template <typename Function>
Model model(Function f) {
  return {f, f};
}

template <typename S>
S square(const S& v) {
  return v * v;
}

const std::map<std::string, Model>& models() {
  using Row = std::vector<double>;
  const auto chwirut =
      model([](const auto* b, const Row& d) { return exp(-b[0] * d[1]) / (b[1] + b[2] * d[1]); });
  const auto saturating = model([](const auto* b, const Row& d) { return b[0] * (1.0 - exp(-b[1] * d[1])); });
  const auto gauss = model([](const auto* b, const Row& d) {
    return b[0] * exp(-b[1] * d[1]) + b[2] * exp(-square(d[1] - b[3]) / square(b[4])) +
           b[5] * exp(-square(d[1] - b[6]) / square(b[7]));
  });
  const auto lanczos = model([](const auto* b, const Row& d) {
    return b[0] * exp(-b[1] * d[1]) + b[2] * exp(-b[3] * d[1]) + b[4] * exp(-b[5] * d[1]);
  });
  const auto cubics = model([](const auto* b, const Row& d) {
    const double x = d[1];
    return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1.0 + x * (b[4] + x * (b[5] + x * b[6])));
  });
  static const std::map<std::string, Model> all = {
      {"Bennett5", model([](const auto* b, const Row& d) { return b[0] * pow(b[1] + d[1], -1.0 / b[2]); })},
      {"BoxBOD", saturating},
      {"Chwirut1", chwirut},
      {"Chwirut2", chwirut},
      {"DanWood", model([](const auto* b, const Row& d) { return b[0] * pow(d[1], b[1]); })},
      {"ENSO", model([](const auto* b, const Row& d) {
         const double w = 2.0 * M_PI * d[1];
         return b[0] + b[1] * cos(w / 12.0) + b[2] * sin(w / 12.0) + b[4] * cos(w / b[3]) +
                b[5] * sin(w / b[3]) + b[7] * cos(w / b[6]) + b[8] * sin(w / b[6]);
       })},
      {"Eckerle4", model([](const auto* b, const Row& d) {
         return b[0] / b[1] * exp(-0.5 * square((d[1] - b[2]) / b[1]));
       })},
      {"Gauss1", gauss},
      {"Gauss2", gauss},
      {"Gauss3", gauss},
      {"Hahn1", cubics},
      {"Kirby2", model([](const auto* b, const Row& d) {
         const double x = d[1];
         return (b[0] + x * (b[1] + x * b[2])) / (1.0 + x * (b[3] + x * b[4]));
       })},
      {"Lanczos1", lanczos},
      {"Lanczos2", lanczos},
      {"Lanczos3", lanczos},
      {"MGH09", model([](const auto* b, const Row& d) {
         const double x = d[1];
         return b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]);
       })},
      {"MGH10", model([](const auto* b, const Row& d) { return b[0] * exp(b[1] / (d[1] + b[2])); })},
      {"MGH17", model([](const auto* b, const Row& d) {
         return b[0] + b[1] * exp(-d[1] * b[3]) + b[2] * exp(-d[1] * b[4]);
       })},
      {"Misra1a", saturating},
      {"Misra1b", model([](const auto* b, const Row& d) {
         return b[0] * (1.0 - 1.0 / square(1.0 + b[1] * d[1] / 2.0));
       })},
      {"Misra1c",
       model([](const auto* b, const Row& d) { return b[0] * (1.0 - 1.0 / sqrt(1.0 + 2.0 * b[1] * d[1])); })},
      {"Misra1d",
       model([](const auto* b, const Row& d) { return b[0] * b[1] * d[1] / (1.0 + b[1] * d[1]); })},
      {"Nelson", model([](const auto* b, const Row& d) { return b[0] - b[1] * d[1] * exp(-b[2] * d[2]); })},
      {"Rat42", model([](const auto* b, const Row& d) { return b[0] / (1.0 + exp(b[1] - b[2] * d[1])); })},
      {"Rat43", model([](const auto* b, const Row& d) {
         return b[0] / pow(1.0 + exp(b[1] - b[2] * d[1]), 1.0 / b[3]);
       })},
      {"Roszman1", model([](const auto* b, const Row& d) {
         return b[0] - b[1] * d[1] - atan(b[2] / (d[1] - b[3])) / M_PI;
       })},
      {"Thurber", cubics}};
  return all;
}

std::vector<double> numbers(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> values;
  for (double v = 0.0; stream >> v;) values.push_back(v);
  return values;
}

/// Columns of "  b1 =  start1  start2  value  std".
void add_unknown(Problem& problem, const std::string& columns) {
  const std::vector<double> v = numbers(columns);
  if (v.size() != 4) throw std::runtime_error("a line of starting and certified values has not four numbers");
  problem.starts.resize(2);
  problem.starts[0].push_back(v[0]);
  problem.starts[1].push_back(v[1]);
  problem.value.push_back(v[2]);
  problem.std.push_back(v[3]);
}

}  // namespace

std::vector<std::string> problem_names() {
  std::vector<std::string> names;
  for (const auto& [name, unused] : models()) names.push_back(name);
  return names;
}

Problem read_problem(const std::string& file, const std::string& name) {
  std::ifstream stream(file);
  Problem problem{.name = name};
  bool in_data = false;
  for (std::string line; std::getline(stream, line);) {
    const auto equals = line.find('=');
    if (in_data) {
      if (const std::vector<double> row = numbers(line); row.size() >= 2) problem.rows.push_back(row);
    } else if (line.starts_with("Data:") && line.find(" y ") != std::string::npos &&
               line.find("Response") == std::string::npos) {
      in_data = true;
    } else if (line.starts_with("  b") && equals < 8) {
      add_unknown(problem, line.substr(equals + 1));
    }
  }
  if (problem.rows.empty() || problem.value.empty())
    throw std::runtime_error(file + " is not a NIST problem");
  // Nelson is stated for log(y).
  for (std::vector<double>& row : problem.rows)
    if (name == "Nelson") row[0] = std::log(row[0]);
  return problem;
}

ResidualFunction residuals(const Problem& problem) {
  const Model& f = models().at(problem.name);
  return differentiated([f, rows = problem.rows]<typename S>(const S* b, S* r) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if constexpr (std::is_same_v<S, double>)
        r[i] = f.plain(b, rows[i]) - rows[i][0];
      else
        r[i] = f.jet(b, rows[i]) - rows[i][0];
    }
    return true;
  });
}

}  // namespace ident::nist
