// Priors of what such commands bend, and what they pass for.
#include "ident/gap/open_commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ident {
namespace {

struct Bent {
  const char* name;
  double share;  // of the value: a standard deviation
};
// How far off such constants came out of flights by controllers at 0.4 to 2 kHz, logged at 50 to 500 Hz:
// motors 5 to 30 %, Jp 20 to 95 %, and with Jp what else acts about yaw.
constexpr std::array kBent = {Bent{"omega_m", 0.3}, Bent{"zeta_m", 0.3}, Bent{"Jp", 0.5}, Bent{"kQ", 0.1},
                              Bent{"Jzz", 0.1}};

bool passes_for_commands(const std::string& cause) {
  static constexpr std::array kCauses = {"motor_delay",      "motor_asymmetry",     "parameter:omega_m",
                                         "parameter:zeta_m", "parameter:dead_time", "parameter:Jp"};
  return std::ranges::find(kCauses, cause) != kCauses.end();
}

}  // namespace

Vehicle with_open_motors(const Vehicle& vehicle, double interval) {
  Vehicle open = vehicle;
  for (const auto& [name, share] : kBent)
    if (open.has(name) && open.value(name) > 0) {
      Known& constant = open.parameters[name];
      constant.std = std::max(constant.std.value_or(0.0), share * constant.value);
    }
  Known& dead_time = open.parameters["dead_time"];
  dead_time.std = std::hypot(dead_time.std.value_or(0.0), interval / 2);
  open.correlation = vehicle.correlation.part([](const std::string& name) {
    return name != "dead_time" &&
           std::ranges::none_of(kBent, [&](const Bent& bent) { return name == bent.name; });
  });
  return open;
}

Judged with_open_commands(Judged verdict, double interval) {
  if (std::ranges::any_of(verdict.effects, passes_for_commands)) {
    verdict.sentence = fmt::format(
        "The controller goes on between the commands that were logged, {:.3g} a second, and what it does "
        "there "
        "passes for {}: no cause is named. Log each command that is sent.",
        1 / interval, fmt::join(verdict.effects, " with "));
    return unnamed(std::move(verdict));
  }
  verdict.sentence +=
      " The controller goes on between the commands that were logged: motors count as hardly known.";
  return verdict;
}

}  // namespace ident
