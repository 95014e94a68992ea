// Does the refined model predict the held-out flight not worse, and better, than the stated one?
#include <cmath>
#include <cstdio>
#include <functional>

#include "paired_bootstrap.h"
#include "predict.h"
#include "tables.h"

namespace field {
namespace {

constexpr double kBlock = 3.0;      // s of a bootstrap block
constexpr double kReliableHz = 40;  // commands below this rate do not say what motors did for rates
constexpr double kMaterial = 1.05;  // ratio of errors from which worse matters

struct Tally {
  long cases = 0, worse = 0, worse_by_much = 0, better = 0, same = 0;
  std::vector<double> ratios;
  std::vector<std::string> worse_names;

  void add(const Comparison& c, const std::string& name) {
    ++cases;
    ratios.push_back(c.second / c.first);
    if (std::abs(c.second / c.first - 1) < 1e-9) ++same;
    if (c.second_better()) ++better;
    if (!c.second_worse()) return;
    ++worse;
    if (c.second > kMaterial * c.first) ++worse_by_much;
    char text[64];
    std::snprintf(text, sizeof text, "%s(%.2f)", name.c_str(), c.second / c.first);
    worse_names.push_back(text);
  }

  void print(const char* title) const {
    if (cases == 0) return;
    std::printf("%-34s %s %s %s %3ld   %5.2f %5.2f %5.2f\n", title, share(cases - worse, cases).c_str(),
                share(cases - worse_by_much, cases).c_str(), share(better, cases).c_str(), same,
                quantile(ratios, 0.1), quantile(ratios, 0.5), quantile(ratios, 0.9));
  }
};

struct Tallies {
  Tally velocity, velocity_plain, velocity_full, by_commands, rates, rates_plain, rates_full;
  Tally printed_velocity, printed_rates;
};

// All values that a refinement prints, called known or not.
StatedModel printed_model(StatedModel model, const json& result) {
  if (!result.is_object()) return model;
  for (const auto& [name, parameter] : result["parameters"].items()) {
    if (!parameter["value"].is_number()) continue;
    if (name == "m") {
      model.m = parameter["value"];
    } else {
      model.constants[name] = parameter["value"];
    }
  }
  return model;
}

Comparison compare_windows(const std::vector<double>& stated, const std::vector<double>& refined) {
  return compare(stated, refined, static_cast<int>(std::lround(kBlock / kWindowStep)));
}

const char* verdict(const Comparison& c) {
  return c.second_worse() ? "WORSE " : c.second_better() ? "better" : "      ";
}

void score(const ScoredCase& c, Tallies& tallies, bool details) {
  const StatedModel stated = read_model(c.file("cases", "/vehicle.yaml"));
  const StatedModel refined =
      c.has_refined_file() ? overlay(stated, c.file(c.answers, ".refined.yaml")) : stated;
  const Columns log = read_csv(c.file("held", "/log3.csv"));
  const RotorInput input = has_speeds(log) ? RotorInput::kSpeeds : RotorInput::kCommands;
  const PredictionErrors before = predict(stated, log, input), after = predict(refined, log, input);
  const Comparison velocity = compare_windows(before.velocity, after.velocity);
  const Comparison rates = compare_windows(before.rates, after.rates);
  tallies.velocity.add(velocity, c.name);
  (c.plain() ? tallies.velocity_plain : tallies.velocity_full).add(velocity, c.name);
  const PredictionErrors b = predict(stated, log, RotorInput::kCommands);
  const PredictionErrors a = predict(refined, log, RotorInput::kCommands);
  tallies.by_commands.add(compare_windows(b.velocity, a.velocity), c.name);
  const PredictionErrors p = predict(printed_model(stated, c.refine.result), log, input);
  const Comparison printed = compare_windows(before.velocity, p.velocity);
  tallies.printed_velocity.add(printed, c.name);
  const bool reliable = has_speeds(log) || c.truth["instruments"]["command_hz"].get<double>() >= kReliableHz;
  if (reliable) {
    tallies.rates.add(rates, c.name);
    tallies.printed_rates.add(compare_windows(before.rates, p.rates), c.name);
    (c.plain() ? tallies.rates_plain : tallies.rates_full).add(rates, c.name);
  }
  if (!details) return;
  std::printf(
      "  %s %-5s %-8s exit %d  velocity %.3f -> %.3f (printed %.3f) m/s %s  rates %.3f -> %.3f rad/s %s%s\n",
      c.name.c_str(), c.plain() ? "plain" : "full", has_speeds(log) ? "speeds" : "commands", c.refine.exit,
      velocity.first, velocity.second, printed.second, verdict(velocity), rates.first, rates.second,
      verdict(rates), reliable ? "" : " (seldom commands)");
}

void print_worse(const char* title, const Tally& tally) {
  if (tally.worse_names.empty()) return;
  std::printf("worse in %s:", title);
  for (const auto& name : tally.worse_names) std::printf(" %s", name.c_str());
  std::printf("\n");
}

}  // namespace

void print_prediction(const std::vector<ScoredCase>& cases, bool details) {
  std::printf("\nHeld-out flight, refined against stated constants (paired block bootstrap, 95 %%)\n");
  Tallies t;
  for (const ScoredCase& c : cases) {
    if (c.refine.exit >= 0) score(c, t, details);
  }
  std::printf("%-34s %-15s %-15s %-15s %-5s %s\n", "", "not worse", "nor by 5 %", "better", "same",
              "ratio at 10, 50, 90 %");
  t.velocity.print("velocity, 0.5 s");
  t.velocity_plain.print("  nothing beside constants");
  t.velocity_full.print("  with effects");
  t.by_commands.print("velocity, by commands only");
  t.rates.print("rates, 0.1 s");
  t.rates_plain.print("  nothing beside constants");
  t.rates_full.print("  with effects");
  t.printed_velocity.print("velocity, all values as printed");
  t.printed_rates.print("rates, all values as printed");
  print_worse("velocity", t.velocity);
  print_worse("velocity by commands", t.by_commands);
  print_worse("rates", t.rates);
  print_worse("velocity as printed", t.printed_velocity);
}

}  // namespace field
