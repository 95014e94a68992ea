// A chunk without derivatives, on plain numbers: for any machine.
#include <cmath>

#include "ident/flight/kernel/simulate_chunk.h"

namespace ident {
namespace {

struct AnyMachine {};

}  // namespace

void evaluate_chunk_residuals(const ChunkTask& task, ChunkResult& out) {
  out.cost = 0;
  out.square = out.leverage = out.count = {};
  out.residuals.assign((task.end - task.begin) * kChannels, kNaN);
  ChunkRun<AnyMachine, double> run(task, task.p, task.active, task.gyro_bias.data());
  out.x_end = run(task.x0, [&](std::size_t row, int channel, double r) {
    r *= task.weight[channel];
    const double a = std::abs(r);
    out.cost += a <= task.huber ? r * r : task.huber * (2 * a - task.huber);
    count_residual<AnyMachine>(out, channel, r, task.huber);
    if (row >= task.begin && row < task.end)
      out.residuals[(row - task.begin) * kChannels + static_cast<std::size_t>(channel)] = r;
  });
}

}  // namespace ident
