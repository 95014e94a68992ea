// Priors of what such commands bend, and what they pass for.
#include "ident/gap/verdict/open_commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ident/effects/cause_traits.h"

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

bool is_bent(const std::string& name) {
  return name == "dead_time" ||
         std::ranges::any_of(kBent, [&](const Bent& bent) { return name == bent.name; });
}

bool passes_for_commands(const std::string& cause) { return traits_of(cause).between_rows; }

}  // namespace

Vehicle with_open_motors(const Vehicle& vehicle, double interval) {
  Vehicle open = vehicle;
  for (const auto& [name, share] : kBent)
    if (const auto known = open.parameters.find(name); known != open.parameters.end())
      if (std::optional<double>& std = known->second.std; std && *std > 0)
        std = std::max(*std, share * std::abs(known->second.value));
  Known& dead_time = open.parameters["dead_time"];
  if (!dead_time.std || *dead_time.std > 0)
    dead_time.std = std::hypot(dead_time.std.value_or(0.0), interval / 2);
  open.correlation = vehicle.correlation.part([](const std::string& name) { return !is_bent(name); });
  return open;
}

void doubt_open_motors(Result& result, const Vehicle& stated) {
  for (Parameter& p : result.parameters) {
    if (!is_bent(p.name)) continue;
    p.prior_value.reset(), p.prior_std.reset(), p.pull.reset();
    if (const auto known = stated.parameters.find(p.name);
        known != stated.parameters.end() && known->second.std)
      p.prior_value = known->second.value, p.prior_std = known->second.std;
    p.doubt("left open for what the controller does between the commands that were logged");
  }
}

Vehicle with_stated_motors(Vehicle found, const Vehicle& stated) {
  std::erase_if(found.parameters, [](const auto& constant) { return is_bent(constant.first); });
  for (const auto& constant : stated.parameters)
    if (is_bent(constant.first)) found.parameters.insert(constant);
  found.correlation = found.correlation.part([](const std::string& name) { return !is_bent(name); });
  return found;
}

Judged with_open_commands(Judged verdict, double interval) {
  std::vector<std::string> passed;
  std::ranges::copy_if(verdict.effects, std::back_inserter(passed), passes_for_commands);
  if (!passed.empty()) {
    verdict.sentence += fmt::format(
        " The controller may go on between the commands that were logged, {:.3g} a second, and what it does "
        "there passes for {}: that is not named. Log each command that is sent.",
        1 / interval, fmt::join(passed, " with "));
    return unnamed(std::move(verdict), passed);
  }
  verdict.sentence +=
      " The controller may go on between the commands that were logged: motors, and what acts about yaw, "
      "were "
      "left open for it.";
  return verdict;
}

}  // namespace ident
