// Chooses the flight kernel's instruction set at run time.
#include "ident/estimators/flight_kernel.h"

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
  if (isa == "baseline") return evaluate_chunk_baseline;
#if defined(__x86_64__)
  if (isa == "avx2" && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return evaluate_chunk_avx2;
  if (isa == "avx512" && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma"))
    return evaluate_chunk_avx512;
#endif
  return nullptr;
}

}  // namespace

std::string_view best_isa() {
  for (const std::string_view isa : {"avx512", "avx2"})
    if (kernel_named(isa)) return isa;
  return "baseline";
}

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
