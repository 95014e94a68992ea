// The flight kernel compiled for one instruction set: avx512.
#include "ident/flight/kernel/kernel_impl.h"

namespace ident {

struct IsaAvx512 {
  static constexpr int kBytes = 64;
};

void evaluate_chunk_avx512(const ChunkTask& task, ChunkResult& result) {
  ChunkKernel<IsaAvx512>::evaluate(task, result);
}

}  // namespace ident
