// Asks the processor which instruction sets it has.
#include "ident/core/simd/instruction_set.h"

namespace ident {

bool runs_here(std::string_view isa) {
#if defined(__x86_64__)
  if (isa == "avx2") return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (isa == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma");
#endif
  return isa == "baseline";
}

std::string_view best_isa() {
  for (const std::string_view isa : {"avx512", "avx2"})
    if (runs_here(isa)) return isa;
  return "baseline";
}

}  // namespace ident
