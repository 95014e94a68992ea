// Sums of products of rows of packs: J'J over tiles of samples that stay in the nearest memory.
#pragma once

#include "ident/core/dual.h"

namespace ident {

/// Rows of `packs` packs each; templated so that each instruction set has its own.
template <class Isa>
class PackProducts {
 public:
  PackProducts(const Pack8* rows, std::size_t count, int packs) : rows_(rows), count_(count), packs_(packs) {}

  static int blocks(int packs) { return packs * (packs + 1) / 2; }

  /// `sums`: 8 packs for each block (i, k <= i) of 8 x 8, row by row.
  void square(Pack8* sums) const {
    constexpr std::size_t tile = 32;
    for (int i = 0; i < 8 * blocks(packs_); ++i) sums[i] = Pack8{};
    for (std::size_t from = 0; from < count_; from += tile) {
      const std::size_t to = from + tile < count_ ? from + tile : count_;
      Pack8* sum = sums;
      for (int i = 0; i < packs_; ++i) {
        int k = 0;
        for (; k + 1 <= i; k += 2, sum += 16) add<2>(from, to, i, k, sum);
        if (k == i) add<1>(from, to, i, k, sum), sum += 8;
      }
    }
  }

 private:
  // Products of pack i with the N packs from k on, summed over samples.
  template <int N>
  void add(std::size_t from, std::size_t to, int i, int k, Pack8* sum) const {
    const auto stride = static_cast<std::size_t>(packs_);
    Pack8 s[8 * N];
#pragma GCC unroll 16
    for (int j = 0; j < 8 * N; ++j) s[j] = sum[j];
    for (std::size_t n = from; n < to; ++n) {
      const Pack8* row = rows_ + n * stride;
      const double* left = reinterpret_cast<const double*>(row + i);
#pragma GCC unroll 2
      for (int m = 0; m < N; ++m) {
        const Pack8 right = row[k + m];
#pragma GCC unroll 8
        for (int j = 0; j < 8; ++j) s[8 * m + j] += left[j] * right;
      }
    }
#pragma GCC unroll 16
    for (int j = 0; j < 8 * N; ++j) sum[j] = s[j];
  }

  const Pack8* rows_;
  std::size_t count_;
  int packs_;
};

}  // namespace ident
