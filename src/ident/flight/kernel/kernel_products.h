// Sums of products of rows of vectors: J'J over tiles of samples that stay in the nearest cache.
#pragma once

#include "ident/core/dual.h"

namespace ident {

/// Rows of `columns` doubles, a multiple of the width of a vector; templated so that each instruction set has
/// its own.
template <class Isa>
class RowProducts {
 public:
  using Vector = typename VectorOf<double, Isa::kBytes>::type;
  static constexpr int lanes = Isa::kBytes / 8;

  RowProducts(const Vector* rows, std::size_t count, int columns)
      : rows_(rows), count_(count), stride_(static_cast<std::size_t>(columns / lanes)), columns_(columns) {}

  /// `sums` has as many rows as columns. What is right of the vector that holds the diagonal stays unchanged.
  void square(Vector* sums) const {
    constexpr std::size_t tile = 32;
    for (std::size_t i = 0; i < static_cast<std::size_t>(columns_) * stride_; ++i) sums[i] = Vector{};
    for (std::size_t from = 0; from < count_; from += tile) {
      const std::size_t to = from + tile < count_ ? from + tile : count_;
      for (int row = 0; row < columns_; row += kRows) {
        const int vectors = (row + kRows - 1) / lanes + 1;
        int at = 0;
        for (; at + kVectors <= vectors; at += kVectors) add<kVectors>(from, to, row, at, sums);
        if (vectors - at == 2) add<2>(from, to, row, at, sums);
        if (vectors - at == 1) add<1>(from, to, row, at, sums);
      }
    }
  }

 private:
  // Number of sums that the 32 or 16 registers hold.
  static constexpr int kRows = Isa::kBytes == 64 ? 8 : 4, kVectors = Isa::kBytes == 32 ? 3 : 2;

  // Products of kRows columns with the N vectors from `at` on, summed over samples.
  template <int N>
  void add(std::size_t from, std::size_t to, int first, int at, Vector* sums) const {
    Vector s[kRows * N];
    Vector* sum = sums + static_cast<std::size_t>(first) * stride_ + at;
#pragma GCC unroll 8
    for (int j = 0; j < kRows; ++j)
#pragma GCC unroll 4
      for (int m = 0; m < N; ++m) s[N * j + m] = sum[static_cast<std::size_t>(j) * stride_ + m];
    for (std::size_t n = from; n < to; ++n) {
      const Vector* row = rows_ + n * stride_;
      const double* left = reinterpret_cast<const double*>(row) + first;
      Vector right[N];
#pragma GCC unroll 4
      for (int m = 0; m < N; ++m) right[m] = row[at + m];
#pragma GCC unroll 8
      for (int j = 0; j < kRows; ++j)
#pragma GCC unroll 4
        for (int m = 0; m < N; ++m) s[N * j + m] += left[j] * right[m];
    }
#pragma GCC unroll 8
    for (int j = 0; j < kRows; ++j)
#pragma GCC unroll 4
      for (int m = 0; m < N; ++m) sum[static_cast<std::size_t>(j) * stride_ + m] = s[N * j + m];
  }

  const Vector* rows_;
  std::size_t count_, stride_;
  int columns_;
};

}  // namespace ident
