// One value from several files, whether they agree or not.
#pragma once

#include <vector>

#include "ident/result/result.h"

namespace ident {

/// What one file found: value, standard deviation, and the degrees of freedom of the latter.
struct FileEstimate {
  double value, std, dof;
};

/// Files that agree are weighted by their precision. Files that do not (other motors, other days) are a
/// sample of what a next file would give: their scatter sets the interval.
struct PooledEstimate {
  double value = kNaN, std = kNaN, dof = kNaN;
  double scatter = 0.0;  ///< relative standard deviation between files beyond their own errors
  double p_equal = 1.0;  ///< probability of such differences when all files measure the same value
  bool files_differ = false;
};

/// Works on the logarithm: values are positive and their errors relative.
PooledEstimate pool(const std::vector<FileEstimate>& files);

/// The pooled value as a parameter, its interval by the t quantile in the logarithm.
Parameter pooled_parameter(std::string name, const PooledEstimate& pooled, std::string unit,
                           std::string source);

}  // namespace ident
