// Threads that take the next number until there is none.
#include "ident/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace ident {

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work, int threads) {
  if (threads <= 0) threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::atomic<std::size_t> next{0};
  std::exception_ptr thrown;
  std::atomic_flag failed;
  const auto run = [&] {
    try {
      for (std::size_t k = next++; k < count; k = next++) work(k);
    } catch (...) {
      if (!failed.test_and_set()) thrown = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> crew;
  for (int i = 1; i < threads && static_cast<std::size_t>(i) < count; ++i) crew.emplace_back(run);
  run();
  for (std::thread& t : crew) t.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace ident
