// Dense products compiled for one instruction set: avx512.
#include "ident/core/simd/dense_rows_impl.h"

namespace ident {

struct DenseIsaAvx512 {
  static constexpr int kWidth = 8;
};

DenseRows dense_rows_avx512() { return DenseRowsOf<DenseIsaAvx512>::table(); }

}  // namespace ident
