// Chunk results as matrices, shared by the parts of the smoother.
#pragma once

#include <Eigen/Core>

#include "ident/estimators/flight_kernel.h"

namespace ident::chunk {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using ConstRowMap = Eigen::Map<const RowMatrix>;

/// J'J over the state of the chunk and the shared unknowns.
inline ConstRowMap A(const ChunkResult& r) {
  const auto d = static_cast<Eigen::Index>(r.g.size());
  return {r.A.data(), d, d};
}
/// J'r.
inline Eigen::Map<const Eigen::VectorXd> g(const ChunkResult& r) {
  return {r.g.data(), static_cast<Eigen::Index>(r.g.size())};
}
/// Derivative of the end state, n components.
inline ConstRowMap E(const ChunkResult& r, int n) {
  return {r.E.data(), n, static_cast<Eigen::Index>(r.g.size())};
}

}  // namespace ident::chunk
