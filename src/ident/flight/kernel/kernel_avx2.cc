// The flight kernel compiled for one instruction set: avx2.
#include "ident/flight/kernel/kernel_impl.h"

namespace ident {

struct IsaAvx2 {
  static constexpr int kBytes = 32;
};

void evaluate_chunk_avx2(const ChunkTask& task, ChunkResult& result) {
  ChunkKernel<IsaAvx2>::evaluate(task, result);
}

}  // namespace ident
