// How estimates go together: the correlation that makes a covariance of their standard deviations.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace ident {

/// Correlation of named quantities; one that is not in it is independent of all others. Where a quantity is
/// positive by its nature (`ParameterKind::positive`, moments of inertia) that of its logarithm is meant,
/// which is the same to first order.
struct Correlation {
  std::vector<std::string> names;
  Eigen::MatrixXd matrix;  ///< symmetric, ones on its diagonal

  bool empty() const { return names.empty(); }
  /// Of two of them; 0 where one is not in it, 1 of a name with itself.
  double of(const std::string& a, const std::string& b) const;
  /// That of some of the names alone. A name without any finite pair is left out; a pair that is not finite
  /// counts as independent.
  Correlation part(const std::function<bool(const std::string&)>& kept) const;
  /// This and another one, which share no name, as independent of each other.
  Correlation beside(const Correlation& other) const;
  /// This where `is_new` does not hold, and `found` where it does; the two are independent.
  Correlation renewed(const Correlation& found, const std::function<bool(const std::string&)>& is_new) const;
};

}  // namespace ident
