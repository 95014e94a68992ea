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

namespace {

/// ", about 20 s left" once a tenth is done: before, the guess would jump.
std::string time_left(double seconds, double share) {
  if (share < 0.1 || share >= 1.0) return "";
  const double left = seconds * (1.0 - share) / share;
  return left < 90 ? fmt::format(", about {:.0f} s left", left)
                   : fmt::format(", about {:.0f} min left", left / 60);
}

}  // namespace

struct Progress::State {
  std::string what;
  bool on_terminal = ::isatty(STDERR_FILENO) != 0;
  Clock::time_point start = Clock::now();
  Clock::time_point next = start + std::chrono::seconds(1);
  bool shown = false;
  std::mutex mutex;
};

Progress::Progress(std::string what) : state_(std::make_unique<State>()) { state_->what = std::move(what); }

Progress::~Progress() {
  if (state_->shown) fmt::print(stderr, "\r\033[K");
}

void Progress::update(double share, const std::string& now) {
  if (!state_->on_terminal) return;
  const std::lock_guard lock(state_->mutex);
  if (Clock::now() < state_->next) return;
  state_->next = Clock::now() + std::chrono::milliseconds(100);
  state_->shown = true;
  const double done = std::clamp(share, 0.0, 1.0);
  fmt::print(stderr, "\r\033[K{} {:.0f} %{}{}{}", state_->what, 100.0 * done,
             time_left(std::chrono::duration<double>(Clock::now() - state_->start).count(), done),
             now.empty() ? "" : ": ", now);
  std::fflush(stderr);
}

}  // namespace ident::app
