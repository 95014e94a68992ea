// Chooses the flight kernel's instruction set at run time.
#include "ident/flight/kernel/kernel.h"

#include "ident/core/simd/instruction_set.h"

namespace ident {

void evaluate_chunk_residuals(const ChunkTask& task, ChunkResult& result);
void evaluate_chunk_baseline(const ChunkTask& task, ChunkResult& result);
#if defined(__x86_64__)
void evaluate_chunk_avx2(const ChunkTask& task, ChunkResult& result);
void evaluate_chunk_avx512(const ChunkTask& task, ChunkResult& result);
#endif

namespace {

using Kernel = void (*)(const ChunkTask&, ChunkResult&);

Kernel kernel_named(std::string_view isa) {
  if (!runs_here(isa)) return nullptr;
#if defined(__x86_64__)
  if (isa == "avx2") return evaluate_chunk_avx2;
  if (isa == "avx512") return evaluate_chunk_avx512;
#endif
  return evaluate_chunk_baseline;
}

}  // namespace

void evaluate_chunk(const ChunkTask& task, ChunkResult& result) {
  static const Kernel with_slopes = kernel_named(best_isa());
  (task.jacobian ? with_slopes : evaluate_chunk_residuals)(task, result);
}

bool evaluate_chunk_with(std::string_view isa, const ChunkTask& task, ChunkResult& result) {
  const Kernel kernel = kernel_named(isa);
  if (kernel) (task.jacobian ? kernel : evaluate_chunk_residuals)(task, result);
  return kernel != nullptr;
}

}  // namespace ident
