// What is negative beyond chance makes up for something else, and nothing that goes with it is known.
#include "ident/flight/checks/implausible_estimates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ident/core/format_number.h"

namespace ident {

void doubt_all(Result& result, std::initializer_list<std::string_view> names, const std::string& why) {
  for (Parameter& p : result.parameters)
    if (std::ranges::find(names, p.name) != names.end()) p.doubt(why);
}

bool is_before_its_command(const Parameter& p) { return p.name == "dead_time" && p.value + 2 * p.std < 0; }

void doubt_negative_dead_time(Result& result) {
  const auto early = std::ranges::find_if(result.parameters, is_before_its_command);
  if (early == result.parameters.end()) return;
  early->doubt({});
  early->note = "negative: no motor turns before its command";
  // What is early makes up for what else is late: motors that are too slow go with it, and rotors whose
  // inertia is ahead of their drag.
  constexpr const char* kWhy = "goes with a negative dead_time, which no motor has";
  doubt_all(result, {"omega_m", "zeta_m", "Jp"}, kWhy);
  if (!result.find("Jp"))
    doubt_all(result, {"kQ", "Jzz"}, kWhy);  // what rotors do about yaw is done by these
  std::erase_if(result.warnings, [](const Warning& w) { return w.code == "dead_time"; });  // says less
  result.warn(
      "negative_dead_time",
      "Rotors seem to follow their commands before these come (dead_time below 0 by over 2 standard "
      "deviations). Motor lag and Jp are not identifiable. Clocks of commands and sensors differ, commands "
      "were logged coarsely, or the model lacks an effect: log every command and run `ident gap`.");
}

void doubt_negative_rotor_inertia(Result& result) {
  const Parameter* Jp = result.find("Jp");
  if (!Jp || !(Jp->value + 2 * Jp->std < 0)) return;
  doubt_all(result, {"Jp", "Jzz", "kQ"}, "goes with a negative Jp, which no rotor has");
  std::erase_if(result.warnings, [](const Warning& w) { return w.code == "rotor_inertia"; });  // says less
  result.warn("negative_rotor_inertia",
              "The vehicle turns with rotors that speed up, not against them (Jp below 0 by over 2 standard "
              "deviations). Jp, Jzz and kQ are not identifiable. Check the spin of each rotor in the vehicle "
              "file, then run `ident gap`.");
}

void doubt_motors_without_effect(Result& result) {
  constexpr double kSlower = 5.0, kLong = 1.0;  // times the lag as stated; s, slower than any motor
  const Parameter *omega_m = result.find("omega_m"), *zeta_m = result.find("zeta_m");
  if (!omega_m || !zeta_m) return;
  const auto lag = [](double zeta, double omega) {
    return omega > 0 ? 2 * zeta / omega : std::numeric_limits<double>::infinity();
  };
  const double found = lag(zeta_m->value, omega_m->value),
               stated = omega_m->prior_value && zeta_m->prior_value
                            ? lag(*zeta_m->prior_value, *omega_m->prior_value)
                            : 0.0;
  if (!(found > kLong && found > kSlower * stated)) return;
  doubt_all(result, {"omega_m", "zeta_m", "dead_time", "km", "Jxx", "Jyy", "Jzz"},
            "motors as fitted hardly follow their commands");
  result.warn("motors_without_effect",
              fmt::format("The fit gives motors a lag of {} s{}: they hardly follow their commands. Motor "
                          "constants, km and inertia are not identifiable. Check that the commands belong to "
                          "this vehicle and flight, then run `ident gap`.",
                          format_number(found, 2),
                          stated > 0 ? fmt::format(" (stated: {} s)", format_number(stated, 2)) : ""));
}

void doubt_coarse_commands(Result& result) {
  if (result.has_warning("coarse_commands"))
    doubt_all(result, {"omega_m", "zeta_m", "dead_time", "Omega_0"}, "commands were logged in coarse steps");
}

void doubt_seldom_speeds(Result& result) {
  if (result.has_warning("low_rate") || result.has_warning("seldom_speeds"))
    doubt_all(result, {"kQ", "Jp", "Jxx", "Jyy", "Jzz", "Jxy", "Jxz", "Jyz"},
              "what the rotors do between samples that far apart was not measured");
}

void doubt_contradicted(Result& result) {
  if (result.has_warning("contradicted"))
    doubt_all(result, {"kT", "km", "omega_m", "zeta_m", "dead_time", "Omega_0", "kQ", "Jzz"},
              "depends on a constant that the logs contradict");
}

void doubt_drawn_away(Result& result) {
  constexpr double kFar = 3.0, kTogether = 0.95;  // standard deviations as stated; correlation
  std::vector<std::string> drawn;
  for (const Parameter& p : result.parameters)
    if (!p.identifiable && p.prior_value && p.prior_std &&
        std::abs(p.value - *p.prior_value) > kFar * *p.prior_std)
      drawn.push_back(p.name);
  for (Parameter& p : result.parameters)
    for (const std::string& other : drawn)
      if (p.name != other && std::abs(result.correlation.of(p.name, other)) > kTogether)
        p.doubt("known only together with " + other + ", which flight draws far from what was stated");
  if (std::ranges::find(drawn, "Jp") != drawn.end())  // what rotors do about yaw is done by these
    doubt_all(result, {"kQ", "Jzz"}, "goes with Jp, which flight draws far from what was stated");
}

void doubt_where_worse(Result& result, const std::string& how) {
  constexpr double kFar = 5.0;  // deviations
  for (Parameter& p : result.parameters)
    if (p.pull && std::abs(*p.pull) > kFar)
      p.doubt("far from what was stated, and other flight is predicted worse for it");
  result.warn("predicts_worse", how);
}

}  // namespace ident
