// A problem of the NIST StRD collection: data, starts, certified values, model.
#pragma once

#include <string>
#include <vector>

#include "ident/lsq/least_squares.h"

namespace ident::nist {

struct Problem {
  std::string name;
  std::vector<std::vector<double>> starts;  ///< [start][unknown]
  std::vector<double> value, std;           ///< certified
  std::vector<std::vector<double>> rows;    ///< y, x (or y, x1, x2)
};

/// Names of all 27 problems.
std::vector<std::string> problem_names();

/// Reads a file as NIST wrote it; throws std::runtime_error when it is not one.
Problem read_problem(const std::string& file, const std::string& name);

/// Residuals of the problem's model, differentiated automatically.
ResidualFunction residuals(const Problem& problem);

}  // namespace ident::nist
