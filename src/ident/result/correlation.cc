// Parts of correlation matrices.
#include "ident/result/correlation.h"

#include <algorithm>

namespace ident {

using Eigen::Index;
using Eigen::MatrixXd;

double Correlation::of(const std::string& a, const std::string& b) const {
  if (a == b) return 1.0;
  const auto i = std::ranges::find(names, a), k = std::ranges::find(names, b);
  return i == names.end() || k == names.end() ? 0.0 : matrix(i - names.begin(), k - names.begin());
}

Correlation Correlation::part(const std::function<bool(const std::string&)>& kept) const {
  std::vector<Index> at;
  for (Index i = 0; i < matrix.rows(); ++i)
    if (matrix.row(i).array().isFinite().any() && kept(names[static_cast<std::size_t>(i)])) at.push_back(i);
  Correlation out{.matrix = matrix(at, at)};
  for (const Index i : at) out.names.push_back(names[static_cast<std::size_t>(i)]);
  // A pair of which nothing is known, as where one of the two does not vary.
  out.matrix = out.matrix.unaryExpr([](double r) { return std::isfinite(r) ? r : 0.0; });
  out.matrix.diagonal().setOnes();
  return out;
}

Correlation Correlation::beside(const Correlation& other) const {
  Correlation out{.names = names};
  out.names.insert(out.names.end(), other.names.begin(), other.names.end());
  const Index n = matrix.rows(), m = other.matrix.rows();
  out.matrix = MatrixXd::Zero(n + m, n + m);
  out.matrix.topLeftCorner(n, n) = matrix;
  out.matrix.bottomRightCorner(m, m) = other.matrix;
  return out;
}

Correlation Correlation::renewed(const Correlation& found,
                                 const std::function<bool(const std::string&)>& is_new) const {
  return part([&](const std::string& name) { return !is_new(name); }).beside(found.part(is_new));
}

}  // namespace ident
