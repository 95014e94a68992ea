// Scatter of the accelerations from outside over the states of a fit, in the world.
#include "ident/flight/checks/air_exceeds.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "ident/core/format_number.h"

namespace ident {
namespace {

constexpr double kOneSided = 1.645;  // standard deviations of the prior: 5 % of such air, one-sided

}  // namespace

double AirBalance::most() const { return expected.force * std::exp(kOneSided * expected.log_std); }

std::optional<AirBalance> air_balance(const FlightRecord& record, const FlightFit& fit) {
  if (record.layout.v_dot < 0) return std::nullopt;
  struct Sums {
    double seconds = 0;
    Eigen::Vector3d push = Eigen::Vector3d::Zero(), square = Eigen::Vector3d::Zero();
  };
  std::vector<Sums> logs(static_cast<std::size_t>(record.logs));
  const FlightSmoother& smoother = *fit.smoother;
  for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    const FlightState<double>& x = smoother.states()[k];
    const double h = arc.t[place.end] - arc.t[place.begin];
    Eigen::Vector3d push = x.outside.v_dot;
    if (record.layout.attitude >= 0 && x.outside.axes == GustAxes::body) push = rotation(x.body.q_WB) * push;
    Sums& sums = logs[static_cast<std::size_t>(arc.log)];
    sums.seconds += h, sums.push += h * push, sums.square += h * push.cwiseAbs2();
  }
  double square = 0, seconds = 0;
  for (const Sums& log : logs) {
    if (!(log.seconds > 0)) continue;
    square += log.square.sum() - log.push.squaredNorm() / log.seconds;
    seconds += log.seconds;
  }
  if (!(seconds > 0)) return std::nullopt;
  return AirBalance{.expected = gusts_expected(record),
                    .force = record.p[param::m] * std::sqrt(std::max(square / seconds, 0.0))};
}

nlohmann::ordered_json as_json(const AirBalance& air) {
  return {{"level", word_of(air.expected.level)},
          {"stated", air.expected.stated},
          {"force", air.force},
          {"force_of_level", air.expected.force}};
}

void warn_of_excess(Result& result, const std::optional<AirBalance>& air) {
  if (!air || !air->exceeds()) return;
  const std::string_view level = word_of(air->expected.level);
  result.warn(
      "air_exceeds",
      fmt::format(
          "What pushes the vehicle beside the model changes by {} N (standard deviation). Gusts of {} "
          "air{} do {} N, and {} N at most. The rest is an error of the model, was taken for gusts, and "
          "may bias the constants. Run `ident gap`, or state the air of these flights (`air:`).",
          format_number(air->force, 2), level, air->expected.stated ? "" : ", which is assumed,",
          format_number(air->expected.force, 2), format_number(air->most(), 2)));
}

}  // namespace ident
