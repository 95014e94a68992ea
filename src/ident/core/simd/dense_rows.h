// Products and triangular solutions of small dense matrices stored by rows, by the best instruction set of
// this machine. The elimination of states spends most of its time in them.
#pragma once

#include <cstddef>
#include <string_view>

namespace ident {

/// Columns are handled in groups of this size: rows are padded to a multiple of it with zeros.
inline constexpr int kRowPad = 8;
constexpr int padded(int columns) { return (columns + kRowPad - 1) / kRowPad * kRowPad; }

/// A matrix by its first element and the distance of its rows, both in doubles.
struct Rows {
  double* data = nullptr;
  std::ptrdiff_t stride = 0;
};
struct ConstRows {
  const double* data = nullptr;
  std::ptrdiff_t stride = 0;
};

/// One implementation for each instruction set. `columns` are padded.
struct DenseRows {
  /// C += sign A'B: `inner` rows of A and B, `rows` of C.
  void (*add_products)(Rows C, ConstRows A, int rows, ConstRows B, int columns, int inner, double sign);
  /// The same where C is symmetric: only its upper triangle is complete; what is left of the diagonal is
  /// partly or not computed.
  void (*add_upper)(Rows C, ConstRows A, int rows, ConstRows B, int columns, int inner, double sign);
  /// L^-1 R in place of R, with L lower triangular, n x n.
  void (*forward)(ConstRows L, int n, Rows R, int columns);
  /// L^-T R in place of R.
  void (*backward)(ConstRows L, int n, Rows R, int columns);
  /// C = diag(weights) B.
  void (*scale)(Rows C, const double* weights, ConstRows B, int rows, int columns);
  /// C += B, with any number of columns.
  void (*add)(Rows C, ConstRows B, int rows, int columns);
};

/// The implementation for the best instruction set of this machine.
const DenseRows& dense_rows();

/// By name, for tests: baseline, avx2, avx512. Null when the machine lacks it.
const DenseRows* dense_rows_with(std::string_view isa);

}  // namespace ident
