// Time means over the states of a fit.
#include "ident/estimators/flight_steady_push.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace ident {
namespace {

// Of the weight: what matters, and what no gust does for a whole flight, however strong they seem.
constexpr double kMatters = 0.05, kNoGust = 0.15;
constexpr double kBeyondChance = 2.5;
// What stays for long is no gust, however slow the process is that was made of it.
constexpr double kSlowestGust = 1.5;  // s

}  // namespace

bool SteadyPush::matters(double gravity) const {
  return std::abs(mean) > std::max(kMatters * gravity, std::min(kBeyondChance * std, kNoGust * gravity));
}

SteadyPush steady_push(const FlightRecord& record, const FlightFit& fit) {
  if (record.layout.v_dot < 0) return {};
  const FlightSmoother& smoother = *fit.smoother;
  double sum = 0, seconds = 0, variance = 0;
  for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    const FlightState<double>& x = smoother.states()[k];
    const double h = arc.t[place.end] - arc.t[place.begin];
    const Eigen::Vector3d& push = x.outside.v_dot;
    // What drags a vehicle that leans has no part in it. Without attitude the body is taken as level.
    const bool turned = record.layout.attitude >= 0 && x.outside.axes == GustAxes::body;
    sum += h * (turned ? rotation(x.body.q_WB).row(2).dot(push) : push[2]);
    const ColouredNoise& gust = fit.noise.in_log(arc.log).v_dot[2];
    seconds += h, variance += h * 2 * gust.sigma * gust.sigma * std::min(gust.tau, kSlowestGust);
  }
  return {sum / seconds, std::sqrt(variance) / seconds};
}

void warn_of_steady_push(Result& result, const SteadyPush& push, double gravity) {
  if (!push.matters(gravity)) return;
  result.warn(
      "thrust_level",
      fmt::format(
          "in the mean of these logs the rotors as fitted lift {:.0f} % {} than the vehicle felt, and no "
          "gust lasts as long: thrust does not go with the square of the command's speed (another curve, a "
          "battery that sags), a stated constant is wrong, or the model lacks an effect (try ident gap)",
          100 * std::abs(push.mean) / gravity, push.mean > 0 ? "more" : "less"));
  static constexpr std::array<std::string_view, 12> kByThrust = {
      "m", "kT", "km", "Omega_0", "kQ", "Jp", "Jxx", "Jyy", "Jzz", "Jxy", "Jxz", "Jyz"};
  for (Parameter& p : result.parameters)
    if (p.identifiable && std::ranges::find(kByThrust, p.name) != kByThrust.end())
      p.identifiable = false, p.note = "thrust as fitted is not what the vehicle felt";
}

}  // namespace ident
