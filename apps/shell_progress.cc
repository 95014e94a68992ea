// The progress line.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>

#include "command.h"

namespace ident::app {

using Clock = std::chrono::steady_clock;

struct Progress::State {
  std::string what;
  bool on_terminal = ::isatty(STDERR_FILENO) != 0;
  Clock::time_point next = Clock::now() + std::chrono::seconds(1);
  bool shown = false;
  std::mutex mutex;
};

Progress::Progress(std::string what) : state_(std::make_unique<State>()) { state_->what = std::move(what); }

Progress::~Progress() {
  if (state_->shown) fmt::print(stderr, "\r\033[K");
}

void Progress::update(double share) {
  if (!state_->on_terminal) return;
  const std::lock_guard lock(state_->mutex);
  if (Clock::now() < state_->next) return;
  state_->next = Clock::now() + std::chrono::milliseconds(100);
  state_->shown = true;
  fmt::print(stderr, "\r\033[K{} {:.0f} %", state_->what, 100.0 * std::clamp(share, 0.0, 1.0));
  std::fflush(stderr);
}

}  // namespace ident::app
