// The table of `--timing`: wall-clock time of the stages of a command.
#include <fmt/format.h>
#include <sys/resource.h>

#include "ident/core/stage_times.h"
#include "shell.h"

namespace ident::app {
namespace {

// Processor time of the program on all cores, s.
double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

}  // namespace

std::string timing_table() {
  std::string text = fmt::format("{:>8} {:>6}  {}\n", "s", "calls", "stage");
  double sum = 0;
  for (const StageTime& stage : stage_times()) {
    sum += stage.seconds;
    text += fmt::format("{:8.3f} {:6}  {}{}\n", stage.seconds, stage.calls, stage.name,
                        stage.within.empty() ? "" : " (" + stage.within + ")");
  }
  return text + fmt::format("{:8.3f}         in all; {:.3f} s of processor time\n", sum, processor_seconds());
}

}  // namespace ident::app
