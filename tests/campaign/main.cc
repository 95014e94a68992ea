// Runs the bench campaigns and prints their tables: bench_campaign [RUNS [ESTIMATOR]].
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "support/bench_campaign.h"

namespace ident::bench {
namespace {

struct Named {
  std::string name;
  Tallies (*run)(int, std::uint64_t, const Disturbance&);
};

const std::vector<Named>& campaigns() {
  static const std::vector<Named> list = {
#define IDENT_CAMPAIGN(estimator) {#estimator, &estimator##_campaign},
#include "campaigns.def"
#undef IDENT_CAMPAIGN
  };
  return list;
}

}  // namespace
}  // namespace ident::bench

int main(int argc, char** argv) {
  using namespace ident::bench;
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  const std::string wanted = argc > 2 ? argv[2] : "";
  constexpr std::uint64_t seed = 20240501;
  for (const Named& campaign : campaigns()) {
    if (!wanted.empty() && wanted != campaign.name) continue;
    fmt::print("{}\n", as_markdown(campaign.name + ", white noise", campaign.run(runs, seed, {})));
    fmt::print("{}\n", as_markdown(campaign.name + ", 1 % outliers",
                                   campaign.run(runs, seed + 1, {.outliers = 0.01})));
    if (campaign.name != "inertia")  // swings have no order in time
      fmt::print("{}\n", as_markdown(campaign.name + ", autocorrelated noise, rho 0.9",
                                     campaign.run(runs, seed + 2, {.rho = 0.9})));
    std::fflush(stdout);
  }
  return 0;
}
