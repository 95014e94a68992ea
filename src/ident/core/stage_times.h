// Where the time of a command goes: a scope names itself, and its time is added up.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace ident {

/// Measures the enclosing scope as the stage `name`. Time within a stage that starts inside it counts for the
/// inner one only. The stages of one thread nest; those of several threads add up.
class Stage {
 public:
  explicit Stage(const char* name);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  const char* name_;
  Stage* outer_;
  Clock::time_point start_ = Clock::now();
  Clock::duration inside_{0};  // taken by stages inside this one
};

/// Wall-clock time of a stage, s, and how often it was entered.
struct StageTime {
  std::string name, within;  ///< `within`: the stage around it, empty where there is none
  int calls = 0;
  double seconds = 0;
};

/// The stages since the program started, the longest first.
std::vector<StageTime> stage_times();

}  // namespace ident
