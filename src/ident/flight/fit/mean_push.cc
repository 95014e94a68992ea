// Time means over the states of a fit.
#include "ident/flight/fit/mean_push.h"

#include <algorithm>
#include <vector>

namespace ident {
namespace {

// Of the weight: what matters, and what no gust does for a whole flight, however strong they seem.
constexpr double kMatters = 0.05, kNoGust = 0.15;
constexpr double kBeyondChance = 2.5, kBeyondChanceInOne = 3.5;  // of several logs one stands out by chance
constexpr double kLong = 30.0;                                   // s: a whole flight, of 20 gusts
// What stays for long is no gust, however slow the process is that was made of it.
constexpr double kSlowestGust = 1.5;  // s

}  // namespace

double SteadyPush::limit(double gravity) const {
  const double chance = (log ? kBeyondChanceInOne : kBeyondChance) * std;
  return std::max(kMatters * gravity, seconds < kLong ? chance : std::min(chance, kNoGust * gravity));
}

SteadyPush steady_push(const FlightRecord& record, const FlightFit& fit) {
  if (record.layout.v_dot < 0) return {};
  const FlightSmoother& smoother = *fit.smoother;
  struct Sums {
    double push = 0, seconds = 0, variance = 0;
  };
  std::vector<Sums> of_log(static_cast<std::size_t>(record.logs));
  Sums all;
  for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    const FlightState<double>& x = smoother.states()[k];
    const double h = arc.t[place.end] - arc.t[place.begin];
    const Eigen::Vector3d& push = x.outside.v_dot;
    // What drags a vehicle that leans has no part in it. Without attitude the body is taken as level.
    const bool turned = record.layout.attitude >= 0 && x.outside.axes == GustAxes::body;
    const double down = turned ? rotation(x.body.q_WB).row(2).dot(push) : push[2];
    const ColouredNoise& gust = fit.noise.in_log(arc.log).v_dot[2];
    for (Sums* sums : {&all, &of_log[static_cast<std::size_t>(arc.log)]}) {
      sums->push += h * down, sums->seconds += h;
      sums->variance += h * 2 * gust.sigma * gust.sigma * std::min(gust.tau, kSlowestGust);
    }
  }
  const auto mean = [](const Sums& sums, std::optional<int> log) {
    return SteadyPush{sums.push / sums.seconds, std::sqrt(sums.variance) / sums.seconds, sums.seconds, log};
  };
  const double g = record.vehicle->g;
  SteadyPush most = mean(all, {});
  for (int log = 0; log < record.logs && record.logs > 1; ++log) {
    const Sums& sums = of_log[static_cast<std::size_t>(log)];
    if (!(sums.seconds > 0)) continue;
    const SteadyPush one = mean(sums, log);
    if (std::abs(one.mean) / one.limit(g) > std::abs(most.mean) / most.limit(g)) most = one;
  }
  return most;
}

}  // namespace ident
