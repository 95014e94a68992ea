// Work that has no order, on all processors.
#pragma once

#include <cstddef>
#include <functional>

namespace ident {

/// Calls `work` for 0 to count - 1, each once and in any order, on that many threads; 0: as many as there are
/// processors. What one of the calls throws is thrown here once all threads have ended.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work, int threads = 0);

}  // namespace ident
