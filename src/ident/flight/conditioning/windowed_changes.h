// Changes over short windows of one flight signal beside those that another signal predicts, and how well
// they agree: what tells a reversed or exchanged axis without any fit.
//
// With x' = y, the change of the running mean of x over a lag equals that of the integral of y, whatever the
// noise of single samples: no signal is ever differentiated from row to row.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "ident/flight/record/flight_record.h"

namespace ident {

/// One value a row.
using Track = std::vector<double>;
using Track3 = std::array<Track, 3>;

/// Windows in rows: running means over `width`, changes over `lag`, a value every `stride`.
struct ChangeWindows {
  std::size_t lag = 1, width = 1, stride = 1, margin = 0;  ///< margin: rows left free for shifts
};
ChangeWindows change_windows(double lag, double interval);

/// Sums of a track up to every row, from which changes over any windows are read.
struct RunningSum {
  Track up_to;  ///< one value more than rows

  RunningSum(const Track& x = {});
  std::size_t rows() const { return up_to.size() - 1; }
};

/// Changes of the running mean; `shift` rows (at most the margin) let the track lead.
Track changes(const RunningSum& x, const ChangeWindows& windows, long shift = 0);

/// The running integral of y over an arc's time.
Track integral(const std::vector<double>& t, const Track& y);

/// A channel of the arc without gaps; empty when nothing was sampled.
Track channel_track(const FlightArc& arc, int channel);

/// A track with what lies beyond its central 99 % pulled in, its mean taken off and its length made one;
/// empty when it does not move or is too short to say.
Track clipped_unit(Track x);

/// Pearson's correlation of two such; 0 when one is empty.
double correlation(const Track& a, const Track& b);

/// Correlation of each seen axis (row) with each told axis (column).
Eigen::Matrix3d correlations(const Track3& seen, const Track3& told);

/// The signal b appended to a, axis by axis.
void append(Track3& a, const Track3& b);

}  // namespace ident
