// Which instruction sets this machine can run.
#pragma once

#include <string_view>

namespace ident {

/// Whether code built for that instruction set runs here: baseline, avx2, avx512.
bool runs_here(std::string_view isa);

/// The best instruction set that runs here.
std::string_view best_isa();

}  // namespace ident
