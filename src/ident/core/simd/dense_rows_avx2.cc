// Dense products compiled for one instruction set: avx2.
#include "ident/core/simd/dense_rows_impl.h"

namespace ident {

struct DenseIsaAvx2 {
  static constexpr int kWidth = 4;
};

DenseRows dense_rows_avx2() { return DenseRowsOf<DenseIsaAvx2>::table(); }

}  // namespace ident
