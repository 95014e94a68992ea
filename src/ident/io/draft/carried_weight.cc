// Squared inputs per specific force, row by row.
#include "ident/io/draft/carried_weight.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ident/core/error.h"
#include "ident/core/statistics.h"
#include "ident/io/log/read_flight_log.h"

namespace ident {
namespace {

constexpr double kFlies = 0.5;           // of the weight: with less thrust it falls
constexpr std::size_t kLeastRows = 100;  // fewer say nothing

bool is_used(const FlightLog& log, double t) {
  return log.windows.empty() ||
         std::ranges::any_of(log.windows, [&](const auto& w) { return w[0] <= t && t <= w[1]; });
}

std::optional<double> at_one_weight(const FlightLog& log, const std::vector<std::vector<double>>& inputs,
                                    double g) {
  std::vector<double> squared;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    double sum = 0;
    for (const std::vector<double>& rotor : inputs) sum += rotor[i] * rotor[i];
    const double weights = log.has_specific_force() ? -log.f_B[2][i] / g : 1.0;
    if (sum > 0 && weights > kFlies && is_used(log, log.t[i]))
      squared.push_back(sum / static_cast<double>(inputs.size()) / weights);
  }
  if (squared.size() < kLeastRows) return std::nullopt;
  return std::sqrt(median(squared));
}

}  // namespace

CarriedWeight carried_weight(const FlightLog& log, double g) {
  return {at_one_weight(log, log.delta, g), at_one_weight(log, log.Omega, g)};
}

CarriedWeight carried_weight(const LogStreams& streams, const Vehicle& vehicle) {
  try {
    return carried_weight(flight_log_of(streams, vehicle, std::nullopt), vehicle.g);
  } catch (const Error&) {  // a log without flight: nothing to say of it
    return {};
  }
}

}  // namespace ident
