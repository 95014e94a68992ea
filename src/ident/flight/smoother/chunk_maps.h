// Chunk results as matrices, shared by the parts of the smoother.
#pragma once

#include <Eigen/Core>

#include "ident/core/simd/dense_rows.h"
#include "ident/flight/kernel/kernel.h"

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

/// Rows for the products of dense_rows.h; `column`: first column.
inline Rows rows_of(RowMatrix& M, int column = 0) { return {M.data() + column, M.cols()}; }
inline ConstRows rows_in(const RowMatrix& M, int column = 0) { return {M.data() + column, M.cols()}; }
inline ConstRows rows_in(const ConstRowMap& M) { return {M.data(), M.cols()}; }

}  // namespace ident::chunk
