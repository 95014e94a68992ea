// A templated residual functor as ResidualFunction, differentiated with Jets a few columns at a time.
#pragma once

#include <ceres/jet.h>

#include <algorithm>
#include <vector>

#include "ident/lsq/least_squares.h"

namespace ident {

/// `functor(const Scalar* x, Scalar* r)` for Scalar = double and Jet, returning false when x is impossible.
template <typename Functor>
ResidualFunction differentiated(Functor functor) {
  constexpr int stride = 4;  // as ceres::DynamicAutoDiffCostFunction
  using Jet = ceres::Jet<double, stride>;
  return [functor = std::move(functor)](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    if (!J) return static_cast<bool>(functor(x.data(), r.data()));
    std::vector<Jet> x_jet(static_cast<std::size_t>(x.size())), r_jet(static_cast<std::size_t>(r.size()));
    for (Eigen::Index first = 0; first < x.size(); first += stride) {
      const Eigen::Index columns = std::min<Eigen::Index>(stride, x.size() - first);
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        Jet& jet = x_jet[static_cast<std::size_t>(i)];
        jet = Jet(x(i));
        if (i >= first && i < first + columns) jet.v(i - first) = 1.0;
      }
      if (!functor(x_jet.data(), r_jet.data())) return false;
      for (Eigen::Index i = 0; i < r.size(); ++i) {
        const Jet& jet = r_jet[static_cast<std::size_t>(i)];
        r(i) = jet.a;
        J->row(i).segment(first, columns) = jet.v.head(columns).transpose();
      }
    }
    return true;
  };
}

}  // namespace ident
