// The flight kernel compiled for one instruction set: baseline.
#include "ident/flight/kernel/kernel_impl.h"

namespace ident {

struct IsaBaseline {
  static constexpr int kBytes = 16;
};

void evaluate_chunk_baseline(const ChunkTask& task, ChunkResult& result) {
  ChunkKernel<IsaBaseline>::evaluate(task, result);
}

}  // namespace ident
