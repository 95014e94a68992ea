// The rows of J of one chunk, with J'J and the leverages.
#pragma once

#include <vector>

#include "ident/flight/kernel/kernel_columns.h"
#include "ident/flight/kernel/kernel_products.h"

namespace ident {

/// Memory that is kept from chunk to chunk, one for each T. T bears Isa as well: no other build may share its
/// code.
template <class Isa, class T>
T* kernel_table(std::size_t size) {
  thread_local std::vector<T> memory;
  if (memory.size() <= size) memory = std::vector<T>(size + size / 2 + 1);  // never empty
  return memory.data();
}

/// Layout of the columns of J: `packs` of eight with dual numbers first, of `columns` in all.
template <class Isa>
struct KernelPlan {
  const KernelPlace<Isa>* place;
  const KernelColumn<Isa>* column;
  int columns, packs;
};

template <class Isa>
class KernelRows {
 public:
  using Vector = typename RowProducts<Isa>::Vector;
  static constexpr int lanes = RowProducts<Isa>::lanes;

  /// Entries of a row beside those with dual numbers: four at most.
  struct Row {
    int channel = 0, others = 0;
    int column[4] = {};
    double slope[4] = {};
  };

  KernelRows(const ChunkTask& task, const KernelPlan<Isa>& of, std::size_t most) : task_(task), of_(of) {
    J_ = &kernel_table<Isa, Slopes>(most * stride())->vector;
    rows_ = kernel_table<Isa, Row>(most);
  }

  std::size_t count = 0;  ///< of samples

  Vector* slopes(std::size_t sample) { return J_ + sample * stride(); }
  Row& row(std::size_t sample) { return rows_[sample]; }

  /// A = J'J.
  void square(ChunkResult& out) const {
    const int columns = 8 * of_.packs;
    Vector* sums = &kernel_table<Isa, Product>(static_cast<std::size_t>(columns) * stride())->vector;
    RowProducts<Isa>(J_, count, columns).square(sums);
    const double* sum = reinterpret_cast<const double*>(sums);
    for (int i = 0; i < columns; ++i)
      for (int k = 0; k <= i; ++k) put_product(out, i, k, sum[i * columns + k]);
    square_others(out);
  }

  /// Leverage j P j' of each sample with respect to the local state. In a channel with many samples every
  /// third may stand for its neighbours.
  void leverages(ChunkResult& out) const {
    constexpr int kEvery = 3, kMany = 30;
    constexpr std::size_t kTogether = 16 / lanes;  // independent sums; packs come in twos
    int seen[kChannels] = {}, taken[kChannels] = {};
    double sum_of[kChannels] = {};
    const int n = task_.layout.size;
    // Covariances of each state with those of dual numbers, in vectors, and with the others.
    const int first = 8 * of_.packs, others = of_.columns - first;
    Vector* P = &kernel_table<Isa, Covariance>(static_cast<std::size_t>(n) * stride())->vector;
    double* Q = &kernel_table<Isa, OwnCovariance>(static_cast<std::size_t>(others * others))->value;
    for (int i = 0; i < others * others; ++i) Q[i] = 0;
    for (int a = 0; a < n; ++a) {
      Vector* row = P + static_cast<std::size_t>(a) * stride();
      for (std::size_t k = 0; k < stride(); ++k) row[k] = Vector{};
      for (int b = 0; b < n; ++b) {
        const double covariance = task_.covariance[a * n + b];
        const int at = of_.place[a].at - first, with = of_.place[b].at;
        if (with < first)
          row[with / lanes][with % lanes] = covariance;
        else if (at >= 0)
          Q[at * others + with - first] = covariance;
      }
    }
    for (std::size_t s = 0; s < count; ++s) {
      const Row& row = rows_[s];
      const int c = row.channel;
      if (task_.few_leverages && out.count.data()[c] >= kMany && seen[c]++ % kEvery != kEvery / 2) continue;
      const Vector* j = J_ + s * stride();
      Vector sum[kTogether] = {};
      double total = 0;
      const auto add = [&](double ja, int a) {
        const Vector* of_a = P + static_cast<std::size_t>(a) * stride();
        for (std::size_t k = 0; k < stride(); k += kTogether)
#pragma GCC unroll 8
          for (std::size_t i = 0; i < kTogether; ++i) sum[i] += (ja * of_a[k + i]) * j[k + i];
      };
      for (int a = 0; a < n; ++a) {
        if (of_.place[a].at >= first) continue;
        const double ja = j[of_.place[a].at / lanes][of_.place[a].at % lanes];
        if (ja != 0) add(ja, a);
      }
      for (int e = 0; e < row.others; ++e) {
        const int a = of_.column[row.column[e]].external;
        if (a >= n) continue;  // a bias is not part of the state
        add(2 * row.slope[e], a);
        for (int f = 0; f < row.others; ++f)
          total += row.slope[e] * row.slope[f] * Q[(row.column[e] - first) * others + row.column[f] - first];
      }
      for (std::size_t i = 0; i < kTogether; ++i)
        for (int k = 0; k < lanes; ++k) total += sum[i][k];
      sum_of[c] += total, taken[c] += 1;
    }
    for (int c = 0; c < kChannels; ++c)
      if (taken[c] > 0) out.leverage.data()[c] += sum_of[c] * (out.count.data()[c] / taken[c]);
  }

 private:
  // Types of their own for each use.
  struct Slopes {
    Vector vector;
  };
  struct Covariance {
    Vector vector;
  };
  struct Product {
    Vector vector;
  };
  struct CrossProduct {
    Vector vector;
  };
  struct OwnProduct {
    double sum;
  };
  struct OwnCovariance {
    double value;
  };

  // The rest of A: products of the columns without dual numbers.
  void square_others(ChunkResult& out) const {
    const int first = 8 * of_.packs, others = of_.columns - first;
    const auto size = static_cast<std::size_t>(others);
    Vector* across = &kernel_table<Isa, CrossProduct>(size * stride())->vector;
    double* own = &kernel_table<Isa, OwnProduct>(size * size)->sum;
    for (std::size_t i = 0; i < size * stride(); ++i) across[i] = Vector{};
    for (std::size_t i = 0; i < size * size; ++i) own[i] = 0;
    for (std::size_t s = 0; s < count; ++s) {
      const Row& row = rows_[s];
      const Vector* j = J_ + s * stride();
      for (int e = 0; e < row.others; ++e) {
        const int at = row.column[e] - first;
        Vector* sum = across + static_cast<std::size_t>(at) * stride();
        for (std::size_t k = 0; k < stride(); ++k) sum[k] += row.slope[e] * j[k];
        for (int f = 0; f < row.others; ++f)
          own[at * others + row.column[f] - first] += row.slope[e] * row.slope[f];
      }
    }
    for (int i = 0; i < others; ++i) {
      const double* sum = reinterpret_cast<const double*>(across + static_cast<std::size_t>(i) * stride());
      for (int k = 0; k < first; ++k) put_product(out, first + i, k, sum[k]);
      for (int k = 0; k <= i; ++k) put_product(out, first + i, first + k, own[i * others + k]);
    }
  }

  void put_product(ChunkResult& out, int i, int k, double product) const {
    const int r = of_.column[i].external, c = of_.column[k].external;
    if (r < 0 || c < 0) return;
    const int d = task_.layout.size + task_.thetas;
    out.A.data()[r * d + c] = out.A.data()[c * d + r] = product;
  }

  std::size_t stride() const { return static_cast<std::size_t>(8 * of_.packs / lanes); }  // of J, in vectors

  const ChunkTask& task_;
  KernelPlan<Isa> of_;
  Vector* J_ = nullptr;
  Row* rows_ = nullptr;
};

}  // namespace ident
