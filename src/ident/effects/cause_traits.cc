// One line a cause.
#include "ident/effects/cause_traits.h"

#include <algorithm>
#include <array>

namespace ident {
namespace {

using Names = std::array<std::string_view, 5>;

// A point mass at a place moves all of them (payload.h).
constexpr Names kOfPayload = {"cg_offset", "parameter:m", "parameter:Jxx", "parameter:Jyy", "parameter:Jzz"};
// A disc that flaps back pulls as a rotor that drags (blade_flapping.h).
constexpr std::array<std::string_view, 1> kOfFlapping = {"rotor_drag"};
// Moving air pushes through whichever drag there is (wind.h).
constexpr std::array<std::string_view, 2> kOfWind = {"rotor_drag", "parasitic_drag"};

// Each pair once. A shift, a weak rotor and a payload go together with a correlation of 0.98 in gentle flight
// (tests/withheld). Of the others physics says it.
using Pair = std::array<std::string_view, 2>;
constexpr std::array kLookAlikes = {
    Pair{"cg_offset", "rotor_mismatch"},
    Pair{"cg_offset", "payload"},
    Pair{"cg_offset", "imu_lever_arm"},  // the sensor sits off the centre of gravity, whichever moved
    Pair{"parameter:m", "payload"},
    Pair{"parameter:m", "parameter:kT"},   // flight tells thrust over mass
    Pair{"rotor_mismatch", "rotor_tilt"},  // a steady moment of one rotor
    Pair{"imu_bias", "imu_misalignment"},  // level, gravity through a small angle is a bias
    Pair{"motor_delay", "sensor_delay"},   // commands late, or readings
    Pair{"blade_flapping", "rotor_drag"},  // a disc that flaps back pulls as a rotor that drags
};

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

bool look_alike(std::string_view cause, std::string_view other) {
  return std::ranges::any_of(kLookAlikes, [&](const Pair& pair) {
    return (pair[0] == cause && pair[1] == other) || (pair[1] == cause && pair[0] == other);
  });
}

std::span<const std::array<std::string_view, 2>> all_look_alikes() { return kLookAlikes; }

std::span<const CauseTraits> all_cause_traits() { return kTraits; }

}  // namespace ident
