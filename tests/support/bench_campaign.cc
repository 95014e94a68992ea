// Generators and tallies of the bench campaigns. The equations here are written out anew, not the library's.
#include "support/bench_campaign.h"

#include <fmt/format.h>

#include <cmath>

namespace ident::bench {
namespace {

double square(double v) { return v * v; }

}  // namespace

double Random::log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

double ColouredNoise::next() {
  last_ = started_ ? rho_ * last_ + std::sqrt(1.0 - rho_ * rho_) * random_.normal() : random_.normal();
  started_ = true;
  return last_;
}

BenchVehicle random_vehicle(Random& random) {
  BenchVehicle v{.mass = random.log_uniform(0.03, 5.0),
                 .arm = random.log_uniform(0.03, 0.5),
                 .thrust_to_weight = random.log_uniform(1.6, 5.0),
                 .km = random.log_uniform(300.0, 3000.0),
                 .omega_m = random.log_uniform(5.0, 80.0),
                 .zeta_m = random.log_uniform(0.4, 2.0),
                 .dead_time = random.log_uniform(0.002, 0.03)};
  // Second moments of the mass along the three axes: any three positive ones make a body.
  const double x = v.mass * square(v.arm) * random.uniform(0.15, 0.4), y = x * random.uniform(0.8, 1.25),
               z = x * random.uniform(0.02, 0.3);
  v.Jxx = y + z;
  v.Jyy = x + z;
  v.Jzz = x + y;
  return v;
}

void Tally::add(const Parameter& estimate, double truth, double cramer_rao) {
  const double z = (estimate.value - truth) / estimate.std;
  ++runs;
  covered += estimate.ci95[0] <= truth && truth <= estimate.ci95[1];
  error += z;
  square += z * z;
  bound_square += (estimate.value - truth) * (estimate.value - truth) / (cramer_rao * cramer_rao);
}

double Tally::spread() const { return std::sqrt(square / runs); }

double Tally::efficiency() const { return std::sqrt(bound_square / runs); }

std::string as_markdown(const std::string& title, const Tallies& tallies) {
  std::string text = fmt::format(
      "{}\n\n| parameter | runs | bias [std] | spread [std] | RMS error / bound | 95 % interval holds |\n"
      "|---|---|---|---|---|---|\n",
      title);
  for (const auto& [name, t] : tallies)
    text += fmt::format("| {} | {} | {:+.3f} | {:.3f} | {:.3f} | {:.1f} % |\n", name, t.runs, t.bias(),
                        t.spread(), t.efficiency(), 100.0 * t.coverage());
  return text;
}

}  // namespace ident::bench
