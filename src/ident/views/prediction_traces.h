// What models predict over short windows of held-out flight, as traces over what was measured.
#pragma once

#include "ident/flight/fit/prediction.h"
#include "ident/result/result.h"

namespace ident {

/// A model whose predictions are drawn, with its name in the legend.
struct TracedModel {
  std::string name;
  const Theta* theta = nullptr;
  Eigen::VectorXd u;
};

/// The channels in which `after` misses less than `before`, those that gain most first: windows of one
/// horizon.
std::vector<int> channels_that_gain(const std::vector<PredictionWindow>& before,
                                    const std::vector<PredictionWindow>& after);

/// One plot for each channel and horizon, over the first log of the record: windows laid end to end, each
/// from a state estimated out of the past only. Attitude, which has no single number, is left out.
std::vector<Plot> prediction_traces(const FlightRecord& record, const TracedModel& before,
                                    const TracedModel& after, const NoiseModel& noise,
                                    const std::vector<int>& channels, const std::vector<double>& horizons);

}  // namespace ident
