// Runs the bench campaigns and prints their tables: bench_campaign [RUNS [ESTIMATOR [NOISE [SEED]]]], NOISE
// one of white, outliers, coloured, all.
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

struct Kind {
  std::string name, title;
  Disturbance disturbance;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {{"white", "white noise", {}},
                                         {"outliers", "1 % outliers", {.outliers = 0.01}},
                                         {"coloured", "autocorrelated noise, rho 0.9", {.rho = 0.9}}};
  return list;
}

}  // namespace
}  // namespace ident::bench

int main(int argc, char** argv) {
  using namespace ident::bench;
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  const std::string wanted = argc > 2 ? argv[2] : "", noise = argc > 3 ? argv[3] : "all";
  const std::uint64_t first_seed = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 20240501;
  for (const Named& campaign : campaigns()) {
    if (!wanted.empty() && wanted != campaign.name) continue;
    std::uint64_t seed = first_seed;  // each kind of noise has vehicles of its own
    for (const Kind& kind : kinds()) {
      const std::uint64_t own = seed++;
      if (noise != "all" && noise != kind.name) continue;
      if (campaign.name == "inertia" && kind.name == "coloured") continue;  // swings have no order in time
      fmt::print("{}\n",
                 as_markdown(campaign.name + ", " + kind.title, campaign.run(runs, own, kind.disturbance)));
      std::fflush(stdout);
    }
  }
  return 0;
}
