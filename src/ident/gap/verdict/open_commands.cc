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

// Sizes that the same flights asked for without such a cause, standard deviations. Motors do not follow what
// is between rows, and what a row shows of it is aliased: thrust seems to fall with the square of what a
// rotor is off hover.
struct BentSize {
  const char *cause, *parameter;
  double std;
};
constexpr std::array kBentSizes = {BentSize{"thrust_curve", "thrust_curve.c", 0.05},
                                   BentSize{"thrust_curve", "thrust_curve.offset", 0.1}};
constexpr double kBeyond = 3.0;  // standard deviations of both

bool is_bent(const std::string& name) {
  return name == "dead_time" ||
         std::ranges::any_of(kBent, [&](const Bent& bent) { return name == bent.name; });
}

// Whether what was not logged may be all of a cause.
bool passes_for_commands(const std::string& cause, std::span<const Parameter> found) {
  if (traits_of(cause).between_rows) return true;
  bool may_bend = false;
  for (const BentSize& size : kBentSizes) {
    const auto at = std::ranges::find(found, size.parameter, &Parameter::name);
    if (cause != size.cause || at == found.end()) continue;
    if (std::abs(at->value) > kBeyond * std::hypot(at->std, size.std)) return false;
    may_bend = true;
  }
  return may_bend;
}

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

void doubt_open_motors(std::vector<Parameter>& parameters) {
  for (Parameter& p : parameters)
    if (is_bent(p.name))
      p.doubt("left open for what the controller does between the commands that were logged");
}

void doubt_open_motors(Result& result, const Vehicle& stated) {
  doubt_open_motors(result.parameters);
  for (Parameter& p : result.parameters) {
    if (!is_bent(p.name)) continue;
    p.prior_value.reset(), p.prior_std.reset(), p.pull.reset();
    if (const auto known = stated.parameters.find(p.name);
        known != stated.parameters.end() && known->second.std)
      p.prior_value = known->second.value, p.prior_std = known->second.std;
  }
}

Vehicle with_stated_motors(Vehicle found, const Vehicle& stated) {
  std::erase_if(found.parameters, [](const auto& constant) { return is_bent(constant.first); });
  for (const auto& constant : stated.parameters)
    if (is_bent(constant.first)) found.parameters.insert(constant);
  found.correlation = found.correlation.part([](const std::string& name) { return !is_bent(name); });
  return found;
}

bool may_be_commands(const std::vector<std::string>& causes, std::span<const Parameter> found) {
  return std::ranges::any_of(causes,
                             [&](const std::string& cause) { return passes_for_commands(cause, found); });
}

Judged with_open_commands(Judged verdict, std::span<const Parameter> found, double interval,
                          const InWords& in_words) {
  std::vector<std::string> passed;
  std::ranges::copy_if(verdict.effects, std::back_inserter(passed),
                       [&](const std::string& cause) { return passes_for_commands(cause, found); });
  if (!passed.empty()) {
    verdict = unnamed(std::move(verdict), passed);
    verdict.sentence = fmt::format(
        "{} What the controller does between the commands that were logged, {:.4g} a second, passes for {}: "
        "that is not named. Log each command that is sent.",
        in_words(verdict), 1 / interval, fmt::join(passed, " with "));
  } else if (verdict.status == "unknown") {
    verdict.sentence += fmt::format(
        " It may be what the controller does between the commands that were logged, {:.4g} a second. Log "
        "each "
        "command that is sent.",
        1 / interval);
  } else {
    verdict.sentence +=
        " The controller may go on between the commands that were logged: motors, and what acts about yaw, "
        "were left open for it.";
  }
  return verdict;
}

}  // namespace ident
