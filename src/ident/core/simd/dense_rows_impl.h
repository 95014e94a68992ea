// Dense products over packs of `Isa::kWidth` doubles, templated so that each instruction set has its own.
// Loops over packs are unrolled explicitly: otherwise GCC keeps the sums in memory at -O2.
#pragma once

#include "ident/core/simd/dense_rows.h"

namespace ident {

template <class Isa>
class DenseRowsOf {
 public:
  static constexpr DenseRows table() { return {add_products, add_upper, forward, backward, scale, add}; }

 private:
  static constexpr int kWidth = Isa::kWidth;
  typedef double Pack __attribute__((vector_size(8 * kWidth), aligned(8), may_alias));

  // Pack number i, counted from x.
  static const Pack& at(const double* x, int pack) {
    return *reinterpret_cast<const Pack*>(x + std::ptrdiff_t{pack} * kWidth);
  }
  static Pack& at(double* x, int pack) { return *reinterpret_cast<Pack*>(x + std::ptrdiff_t{pack} * kWidth); }

  static void add_products(Rows C, ConstRows A, int rows, ConstRows B, int columns, int inner, double sign) {
    int j = 0;
    for (; j + 3 * kWidth <= columns; j += 3 * kWidth) panel<3>(C, A, rows, B, j, inner, sign);
    for (; j < columns; j += kWidth) panel<1>(C, A, rows, B, j, inner, sign);
  }

  static void add_upper(Rows C, ConstRows A, int rows, ConstRows B, int columns, int inner, double sign) {
    const auto above = [rows](int end) { return end < rows ? end : rows; };
    int j = 0;
    for (; j + 3 * kWidth <= columns; j += 3 * kWidth)
      panel<3>(C, A, above(j + 3 * kWidth), B, j, inner, sign);
    for (; j < columns; j += kWidth) panel<1>(C, A, above(j + kWidth), B, j, inner, sign);
  }

  // J packs of columns, starting at `column`.
  template <int J>
  static void panel(Rows C, ConstRows A, int rows, ConstRows B, int column, int inner, double sign) {
    int i = 0;
    for (; i + 4 <= rows; i += 4) block<4, J>(C, A, i, B, column, inner, sign);
    for (; i < rows; ++i) block<1, J>(C, A, i, B, column, inner, sign);
  }

  template <int I, int J>
  static void block(Rows C, ConstRows A, int row, ConstRows B, int column, int inner, double sign) {
    Pack sum[I][J] = {};
    for (int k = 0; k < inner; ++k) {
      const double* left = A.data + k * A.stride + row;
      const double* right = B.data + k * B.stride + column;
#pragma GCC unroll 4
      for (int j = 0; j < J; ++j) {
        const Pack b = at(right, j);
#pragma GCC unroll 4
        for (int i = 0; i < I; ++i) sum[i][j] += left[i] * b;
      }
    }
#pragma GCC unroll 4
    for (int i = 0; i < I; ++i)
#pragma GCC unroll 4
      for (int j = 0; j < J; ++j) at(C.data + (row + i) * C.stride + column, j) += sign * sum[i][j];
  }

  // Number of packs of columns that are solved together, so that sums do not wait for each other.
  static constexpr int kFew = kRowPad / kWidth, kMany = kFew < 4 ? 4 * kFew : 2 * kFew;

  static void forward(ConstRows L, int n, Rows R, int columns) {
    int column = 0;
    for (; column + kMany * kWidth <= columns; column += kMany * kWidth) forward<kMany>(L, n, R, column);
    for (; column < columns; column += kRowPad) forward<kFew>(L, n, R, column);
  }

  template <int J>
  static void forward(ConstRows L, int n, Rows R, int column) {
    for (int i = 0; i < n; ++i)
      solve_row<J>(R, i, column, 0, i, L.data + i * L.stride, 1, L.data[i * L.stride + i]);
  }

  static void backward(ConstRows L, int n, Rows R, int columns) {
    int column = 0;
    for (; column + kMany * kWidth <= columns; column += kMany * kWidth) backward<kMany>(L, n, R, column);
    for (; column < columns; column += kRowPad) backward<kFew>(L, n, R, column);
  }

  template <int J>
  static void backward(ConstRows L, int n, Rows R, int column) {
    for (int i = n - 1; i >= 0; --i)
      solve_row<J>(R, i, column, i + 1, n, L.data + i, L.stride, L.data[i * L.stride + i]);
  }

  static void scale(Rows C, const double* weights, ConstRows B, int rows, int columns) {
    for (int i = 0; i < rows; ++i) {
      const double weight = weights[i];
      for (int j = 0; j < columns; j += kRowPad)
#pragma GCC unroll 4
        for (int k = 0; k < kFew; ++k)
          at(C.data + i * C.stride + j, k) = weight * at(B.data + i * B.stride + j, k);
    }
  }

  static void add(Rows C, ConstRows B, int rows, int columns) {
    for (int i = 0; i < rows; ++i) {
      double* to = C.data + i * C.stride;
      const double* from = B.data + i * B.stride;
      int j = 0;
      for (; j + kWidth <= columns; j += kWidth) at(to + j, 0) += at(from + j, 0);
      for (; j < columns; ++j) to[j] += from[j];
    }
  }

  // Row i of R less the rows [from, to) times their coefficients, over the pivot.
  template <int J>
  static void solve_row(Rows R, int i, int column, int from, int to, const double* coefficient,
                        std::ptrdiff_t stride, double pivot) {
    double* own = R.data + i * R.stride + column;
    Pack x[J];
#pragma GCC unroll 8
    for (int j = 0; j < J; ++j) x[j] = at(own, j);
    for (int k = from; k < to; ++k) {
      const double c = coefficient[k * stride];
      const double* other = R.data + k * R.stride + column;
#pragma GCC unroll 8
      for (int j = 0; j < J; ++j) x[j] -= c * at(other, j);
    }
    const double inverse = 1.0 / pivot;
#pragma GCC unroll 8
    for (int j = 0; j < J; ++j) at(own, j) = inverse * x[j];
  }
};

}  // namespace ident
