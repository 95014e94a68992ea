// Chooses the instruction set of dense products at run time.
#include "ident/core/simd/dense_rows.h"

#include "ident/core/simd/instruction_set.h"

namespace ident {

DenseRows dense_rows_baseline();
#if defined(__x86_64__)
DenseRows dense_rows_avx2();
DenseRows dense_rows_avx512();
#endif

const DenseRows* dense_rows_with(std::string_view isa) {
  if (!runs_here(isa)) return nullptr;
#if defined(__x86_64__)
  static const DenseRows avx2 = dense_rows_avx2(), avx512 = dense_rows_avx512();
  if (isa == "avx2") return &avx2;
  if (isa == "avx512") return &avx512;
#endif
  static const DenseRows baseline = dense_rows_baseline();
  return &baseline;
}

const DenseRows& dense_rows() {
  static const DenseRows& best = *dense_rows_with(best_isa());
  return best;
}

}  // namespace ident
