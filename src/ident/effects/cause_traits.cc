// One line a cause.
#include "ident/effects/cause_traits.h"

#include <algorithm>
#include <array>

namespace ident {
namespace {

// A point mass at a place moves all of them (payload.h).
constexpr std::array<std::string_view, 6> kOfPayload = {
    "cg_offset", "products_of_inertia", "parameter:m", "parameter:Jxx", "parameter:Jyy", "parameter:Jzz"};
// A disc that flaps back pulls as a rotor that drags (blade_flapping.h).
constexpr std::array<std::string_view, 1> kOfFlapping = {"rotor_drag"};
// Moving air pushes through whichever drag there is (wind.h).
constexpr std::array<std::string_view, 2> kOfWind = {"rotor_drag", "parasitic_drag"};

constexpr std::array kTraits = {
    CauseTraits{.name = "payload",
                .moves_mass = true,
                .bolted_on = true,
                .implies = kOfPayload,
                .alias_of = "cg_offset"},
    CauseTraits{.name = "cg_offset", .moves_mass = true},
    CauseTraits{.name = "products_of_inertia", .moves_mass = true},
    CauseTraits{.name = "parameter:m", .moves_mass = true},
    CauseTraits{.name = "parameter:Jxx", .moves_mass = true},
    CauseTraits{.name = "parameter:Jyy", .moves_mass = true},
    CauseTraits{.name = "parameter:Jzz", .moves_mass = true},
    CauseTraits{.name = "imu_bias", .of_mounting = true},
    CauseTraits{.name = "imu_lever_arm", .of_mounting = true},
    CauseTraits{.name = "imu_misalignment", .of_mounting = true},
    CauseTraits{.name = "battery_sag", .of_drive = true, .of_battery = true},
    CauseTraits{.name = "thrust_curve", .of_drive = true},
    CauseTraits{.name = "motor_delay", .of_motors = true, .between_rows = true},
    CauseTraits{.name = "motor_asymmetry", .of_motors = true, .between_rows = true},
    CauseTraits{.name = "parameter:omega_m", .of_motors = true, .of_lag = true, .between_rows = true},
    CauseTraits{.name = "parameter:zeta_m", .of_motors = true, .of_lag = true, .between_rows = true},
    CauseTraits{.name = "parameter:km", .of_motors = true},
    CauseTraits{.name = "parameter:dead_time", .between_rows = true},
    CauseTraits{.name = "parameter:Jp", .between_rows = true},
    CauseTraits{.name = "rotor_mismatch", .per_rotor = true},
    CauseTraits{.name = "rotor_tilt", .per_rotor = true},
    CauseTraits{.name = "rotor_drag", .carries_air = true},
    CauseTraits{.name = "parasitic_drag", .carries_air = true},
    CauseTraits{.name = "blade_flapping", .implies = kOfFlapping},
    CauseTraits{.name = "wind", .by_the_air = true, .implies = kOfWind},
};

}  // namespace

const CauseTraits& traits_of(std::string_view cause) {
  static constexpr CauseTraits kPlain;
  const auto at = std::ranges::find(kTraits, cause, &CauseTraits::name);
  return at == kTraits.end() ? kPlain : *at;
}

bool implies(std::string_view cause, std::string_view other) {
  const auto with = traits_of(cause).implies;
  return std::ranges::find(with, other) != with.end();
}

std::span<const CauseTraits> all_cause_traits() { return kTraits; }

}  // namespace ident
