// One table of stages for the program. It is written by whoever measures and read once, at the end.
#include "ident/core/stage_times.h"

#include <algorithm>
#include <mutex>

namespace ident {
namespace {

thread_local Stage* innermost = nullptr;

struct Table {
  std::mutex mutex;
  std::vector<StageTime> stages;
};

Table& table() {
  static Table the_one;
  return the_one;
}

void add(const std::string& name, const std::string& within, double seconds) {
  Table& t = table();
  const std::lock_guard lock(t.mutex);
  const auto is_it = [&](const StageTime& s) { return s.name == name && s.within == within; };
  auto at = std::ranges::find_if(t.stages, is_it);
  if (at == t.stages.end()) at = t.stages.insert(at, {name, within, 0, 0.0});
  ++at->calls, at->seconds += seconds;
}

}  // namespace

Stage::Stage(const char* name) : name_(name), outer_(innermost) { innermost = this; }

Stage::~Stage() {
  const Clock::duration taken = Clock::now() - start_;
  innermost = outer_;
  if (outer_ != nullptr) outer_->inside_ += taken;
  add(name_, outer_ == nullptr ? "" : outer_->name_, std::chrono::duration<double>(taken - inside_).count());
}

std::vector<StageTime> stage_times() {
  Table& t = table();
  const std::lock_guard lock(t.mutex);
  std::vector<StageTime> sorted = t.stages;
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &StageTime::seconds);
  return sorted;
}

}  // namespace ident
