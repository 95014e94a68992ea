// Dense products compiled for one instruction set: baseline.
#include "ident/core/simd/dense_rows_impl.h"

namespace ident {

struct DenseIsaBaseline {
  static constexpr int kWidth = 2;
};

DenseRows dense_rows_baseline() { return DenseRowsOf<DenseIsaBaseline>::table(); }

}  // namespace ident
