// Refines random vehicles and prints how their errors compare with the bound:
// refine_campaign COUNT still|gusts FILE [FIRST_SEED [JOBS]]. FILE gets a line for each vehicle; those it
// holds already are not flown again.
#include <fmt/format.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "support/flight_campaign.h"

namespace ident::flight_campaign {
namespace {

struct Sums {
  int count = 0, identifiable = 0, inside = 0, inside_naive = 0, wrong = 0;
  double over_bound = 0.0, over_std = 0.0, over_naive = 0.0;

  void add(const Estimate& e) {
    ++count;
    if (!e.identifiable) return;
    ++identifiable;
    const double error = e.value - e.truth;
    over_bound += error * error / (e.bound * e.bound), over_std += error * error / (e.std * e.std);
    over_naive += error * error / (e.naive_std * e.naive_std);
    inside += e.inside, inside_naive += e.inside_naive;
    wrong += !(std::abs(error) < 5 * e.std) || e.bound > 0.75 * e.prior_std;
  }
  std::string row(const std::string& name) const {
    const double n = std::max(identifiable, 1);
    return fmt::format("| {} | {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.1f} % | {:.1f} % | {} |\n", name,
                       count, identifiable, std::sqrt(over_bound / n), std::sqrt(over_std / n),
                       std::sqrt(over_naive / n), 100 * inside / n, 100 * inside_naive / n, wrong);
  }
};

void print_table(const std::vector<Outcome>& outcomes) {
  std::map<std::string, Sums> rows;
  Sums pooled, blind;
  double seconds = 0;
  int failures = 0;
  for (const Outcome& o : outcomes) {
    seconds += o.seconds;
    failures += !o.failure.empty();
    if (!o.failure.empty()) fmt::print("seed {}: {}\n", o.seed, o.failure);
    for (const Estimate& e : o.estimates) {
      rows[e.name].add(e), pooled.add(e);
      if (!o.rotor_speeds) blind.add(e);
      if (e.identifiable && (!(std::abs(e.value - e.truth) < 4 * e.std) || e.bound > 0.75 * e.prior_std))
        fmt::print("seed {}: {} {:.4g}, truth {:.4g}, std {:.2g}, bound {:.2g}, prior's std {:.2g}\n", o.seed,
                   e.name, e.value, e.truth, e.std, e.bound, e.prior_std);
    }
  }
  fmt::print(
      "\n| parameter | vehicles | identifiable | RMS error / bound | / std | / naive std | 95 % interval "
      "holds | "
      "naive one | wrong |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [name, sums] : rows) fmt::print("{}", sums.row(name));
  fmt::print("{}{}", pooled.row("all"), blind.row("all, without rotor speeds"));
  fmt::print("\n{} vehicles, {} failed, {:.1f} s each\n", outcomes.size(), failures,
             seconds / static_cast<double>(std::max<std::size_t>(outcomes.size(), 1)));
}

std::vector<Outcome> stored(const std::string& file) {
  std::vector<Outcome> all;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.ends_with('}')) all.push_back(from_line(line));
  return all;
}

void fly_missing(std::uint64_t first, int count, const CaseOptions& options, const std::string& file,
                 int jobs) {
  std::set<std::uint64_t> done;
  for (const Outcome& o : stored(file)) done.insert(o.seed);
  std::ofstream out(file, std::ios::app);
  std::mutex writing;
  std::atomic<std::uint64_t> next{first};
  const auto work = [&] {
    for (std::uint64_t seed = next++; seed < first + static_cast<std::uint64_t>(count); seed = next++) {
      if (done.contains(seed)) continue;
      Outcome outcome;
      try {
        outcome = refine_case(random_case(seed, options));
      } catch (const std::exception& e) {
        outcome = {.seed = seed, .failure = e.what()};
      }
      const std::lock_guard lock(writing);
      out << as_line(outcome) << std::endl;
    }
  };
  std::vector<std::thread> crew;
  for (int i = 0; i < jobs; ++i) crew.emplace_back(work);
  for (std::thread& t : crew) t.join();
}

}  // namespace
}  // namespace ident::flight_campaign

int main(int argc, char** argv) {
  using namespace ident::flight_campaign;
  const std::map<std::string, CaseOptions> kinds = {
      {"still", {}},
      {"gusts", {.turbulence = true}},
      {"gusts-gyro", {.turbulence = true, .by_gyro = true}},
      {"still-silent", {.silent = true}},
      {"gusts-silent", {.turbulence = true, .silent = true, .by_gyro = true}},
      {"gusts-drift", {.turbulence = true, .drift = 0.004}},
      {"gusts-one-by-one", {.turbulence = true, .by_gyro = true, .one_by_one = true}},
      {"gusts-filter", {.turbulence = true, .filter = true}},
      {"gusts-shaken", {.turbulence = true, .shaken = 2.0}},
      {"still-speeds", {.commands = false}},
      {"gusts-speeds", {.turbulence = true, .commands = false}},
      {"still-many", {.many_rotors = true}},
      {"gusts-many", {.turbulence = true, .by_gyro = true, .many_rotors = true}}};
  const auto kind = kinds.find(argc > 2 ? argv[2] : "");
  if (argc < 4 || kind == kinds.end()) {
    fmt::print(
        stderr,
        "usage: refine_campaign COUNT KIND FILE [FIRST_SEED [JOBS]]\n\n"
        "KIND: still, gusts; gusts-gyro with a controller that flies by the gyro of the log, "
        "gusts-one-by-one "
        "with the same logs one after the other; still-silent, "
        "gusts-silent where nobody states Jp and a dead time; gusts-drift with an attitude that drifts, "
        "gusts-filter "
        "with what a filter shows; gusts-shaken with an IMU that feels the rotors; still-speeds, "
        "gusts-speeds "
        "without commands; still-many, gusts-many with six or eight rotors\n");
    return 2;
  }
  const std::uint64_t first = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1;
  fly_missing(first, std::atoi(argv[1]), kind->second, argv[3], argc > 5 ? std::atoi(argv[5]) : 1);
  print_table(stored(argv[3]));
  return 0;
}
