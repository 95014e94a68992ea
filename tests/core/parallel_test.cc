// Work on all processors: each number once, errors passed on, calls within calls.
#include "ident/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ident {
namespace {

TEST(InParallel, CallsEachNumberOnce) {
  for (const int threads : {0, 1, 2, 7})
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<std::atomic<int>> calls(count);
      in_parallel(
          count, [&](std::size_t k) { ++calls[k]; }, threads);
      for (const auto& n : calls) EXPECT_EQ(n, 1);
    }
}

TEST(InParallel, OneThreadIsTheCaller) {
  const auto caller = std::this_thread::get_id();
  in_parallel(
      50, [&](std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); }, 1);
}

TEST(InParallel, AsManyThreadsAsAskedForWorkAtOnce) {
  std::atomic<int> here{0};
  in_parallel(
      3,
      [&](std::size_t) {
        ++here;
        while (here < 3) std::this_thread::yield();  // ends only if all three came
      },
      3);
  EXPECT_EQ(here, 3);
}

TEST(InParallel, ThrowsWhatACallThrewAndWorksOn) {
  const auto fails = [](std::size_t k) {
    if (k == 17) throw std::runtime_error("17");
  };
  EXPECT_THROW(in_parallel(100, fails, 4), std::runtime_error);
  std::atomic<int> calls{0};
  in_parallel(
      100, [&](std::size_t) { ++calls; }, 4);
  EXPECT_EQ(calls, 100);
}

TEST(InParallel, CallsWithinCallsAndFromManyThreadsEnd) {
  std::atomic<int> calls{0};
  std::vector<std::thread> callers;
  for (int i = 0; i < 5; ++i)
    callers.emplace_back([&] {
      for (int round = 0; round < 50; ++round)
        in_parallel(
            4,
            [&](std::size_t) {
              in_parallel(
                  3, [&](std::size_t) { ++calls; }, 3);
            },
            2);
    });
  for (std::thread& t : callers) t.join();
  EXPECT_EQ(calls, 5 * 50 * 4 * 3);
}

}  // namespace
}  // namespace ident
