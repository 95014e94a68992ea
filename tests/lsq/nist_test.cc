// The 27 nonlinear problems of NIST StRD, from both starts, through the door that the estimators use.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ident/lsq/least_squares.h"
#include "ident/lsq/least_squares_fit.h"
#include "support/nist_problem.h"

namespace ident {
namespace {

/// Correct decimal digits, as NIST counts them (LRE), at most the 11 that are certified.
double digits(double found, double certified) {
  return std::clamp(-std::log10(std::fabs(found - certified) / std::fabs(certified)), 0.0, 11.0);
}

struct Accuracy {
  double value_digits = 11.0, std_digits = 11.0;  ///< of the worst unknown
};

Accuracy solve(const nist::Problem& problem, std::size_t start) {
  LeastSquaresProblem fit{.residuals = static_cast<Eigen::Index>(problem.rows.size()),
                          .evaluate = nist::residuals(problem)};
  for (std::size_t i = 0; i < problem.value.size(); ++i)
    fit.unknowns.push_back({fmt::format("b{}", i + 1), problem.starts[start][i], Coordinate::real});
  const LeastSquaresFit found = solve_least_squares(fit, {.robust = false, .max_colour_order = 0});
  Accuracy run;
  for (std::size_t i = 0; i < problem.value.size(); ++i) {
    const std::string name = fmt::format("b{}", i + 1);
    run.value_digits = std::min(run.value_digits, digits(found.value(name), problem.value[i]));
    run.std_digits = std::min(run.std_digits, digits(found.std(name), problem.std[i]));
  }
  return run;
}

TEST(Nist, All54RunsHaveSixDigitsAndNearlyAllStandardErrorsHaveFour) {
  int good_values = 0, good_errors = 0, runs = 0;
  fmt::print("{:10} {:>5} {:>13} {:>15}\n", "problem", "start", "digits", "digits of std");
  for (const std::string& name : nist::problem_names()) {
    const nist::Problem problem =
        nist::read_problem(fmt::format("{}/tests/lsq/nist/{}.dat", IDENT_SOURCE_DIR, name), name);
    for (std::size_t start = 0; start < 2; ++start) {
      const Accuracy run = solve(problem, start);
      fmt::print("{:10} {:>5} {:13.1f} {:15.1f}\n", name, start + 1, run.value_digits, run.std_digits);
      ++runs;
      good_values += run.value_digits >= 6.0;
      good_errors += run.std_digits >= 4.0;
    }
  }
  fmt::print("at least 6 digits: {} of {}; standard errors at least 4 digits: {} of {}\n", good_values, runs,
             good_errors, runs);
  EXPECT_EQ(runs, 54);
  EXPECT_EQ(good_values, 54);
  EXPECT_GE(good_errors, 51);
}

}  // namespace
}  // namespace ident
