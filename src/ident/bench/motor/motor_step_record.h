// A step recording as the fit needs it: speed samples, and the command as a sequence of edges.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ident/data/table.h"
#include "ident/model/vehicle.h"

namespace ident {

/// From `t` on the command is `delta`, until the next edge.
struct CommandEdge {
  double t = 0.0;
  double delta = 0.0;
  bool down = false;  ///< lower than the command before it
};

/// One uninterrupted recording. Rows without a speed are left out; the first edge lies at or before the first
/// row.
struct StepRecord {
  std::string file;
  std::vector<double> t;      ///< s, not decreasing
  std::vector<double> Omega;  ///< rad/s
  std::vector<double> delta;  ///< that held at the row
  std::vector<CommandEdge> edges;

  std::size_t rows() const { return t.size(); }
};

/// Recordings of a table: command as delta (pulse widths through `range`), split where the recording pauses.
/// Throws DataError when nothing is commanded or nothing turns. Decisions are added to `warnings`.
std::vector<StepRecord> step_records(const NumberTable& table, const std::optional<CommandRange>& range,
                                     std::vector<Warning>& warnings);

/// Do rows come in bursts, as if they had waited in a buffer? Then their times say when they arrived.
bool has_bunched_times(const StepRecord& record);

/// The record with times of equal distance that follow the arrival times over many rows.
StepRecord with_even_times(const StepRecord& record);

}  // namespace ident
