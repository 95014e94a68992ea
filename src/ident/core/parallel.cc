// A crew that stays: threads that take the next number until there is none, and wait for the next call.
#include "ident/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace ident {
namespace {

/// One call of in_parallel(): its numbers, and how many of the crew are at it.
struct Call {
  const std::function<void(std::size_t)>& work;
  std::size_t count;
  std::size_t wanted;  // of the crew, not yet come
  std::size_t at_it = 0;
  std::atomic<std::size_t> next{0};
  std::atomic_flag failed{};
  std::exception_ptr thrown{};

  void run() {
    try {
      for (std::size_t k = next++; k < count; k = next++) work(k);
    } catch (...) {
      if (!failed.test_and_set()) thrown = std::current_exception();
      next = count;
    }
  }
};

/// Threads live as long as the program: to start one takes as long as many a piece of work.
class Crew {
 public:
  Crew() = default;
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() {
    {
      const std::scoped_lock lock(mutex_);
      over_ = true;
    }
    wake_.notify_all();
    for (std::thread& t : threads_) t.join();
  }

  /// The caller works too, and never waits for one of the crew who has not come: calls within calls end.
  void work_on(Call& call) {
    const std::size_t wanted = call.wanted;  // before others count it down
    {
      const std::scoped_lock lock(mutex_);
      while (threads_.size() < wanted) threads_.emplace_back([this] { serve(); });
      open_.push_back(&call);
    }
    if (wanted == 1)
      wake_.notify_one();
    else
      wake_.notify_all();
    call.run();
    std::unique_lock lock(mutex_);
    std::erase(open_, &call);
    done_.wait(lock, [&] { return call.at_it == 0; });
  }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [this] { return over_ || !open_.empty(); });
      if (over_) return;
      Call& call = *open_.front();
      if (--call.wanted == 0) open_.pop_front();
      ++call.at_it;
      lock.unlock();
      call.run();
      lock.lock();
      if (--call.at_it == 0) done_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::deque<Call*> open_;
  std::vector<std::thread> threads_;
  bool over_ = false;
};

std::size_t processors() {
  static const std::size_t count = std::max(1U, std::thread::hardware_concurrency());
  return count;
}

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work, int threads) {
  static Crew crew;
  const std::size_t most = threads > 0 ? static_cast<std::size_t>(threads) : processors();
  Call call{work, count, std::min(most, count) - std::min<std::size_t>(count, 1)};
  if (call.wanted == 0)
    call.run();
  else
    crew.work_on(call);
  if (call.thrown) std::rethrow_exception(call.thrown);
}

}  // namespace ident
