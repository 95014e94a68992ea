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

// Signatures that go together with a correlation of 0.98 in gentle flight.
template <std::size_t n>
using Alike = std::array<std::string_view, n>;
constexpr Alike<3> kLikeShift = {"rotor_mismatch", "payload", "imu_lever_arm"};
constexpr Alike<2> kLikePayload = {"cg_offset", "parameter:m"};
constexpr Alike<2> kLikeMass = {"parameter:kT", "payload"};  // thrust over mass is what flight tells
constexpr Alike<1> kLikeThrust = {"parameter:m"};
constexpr Alike<1> kLikeMismatch = {"rotor_tilt"};  // either is a moment for each rotor
constexpr Alike<1> kLikeTilt = {"rotor_mismatch"};
constexpr Alike<1> kLikeTurnedImu = {"imu_bias"};  // gravity through a small angle is a bias in level flight
constexpr Alike<1> kLikeBias = {"imu_misalignment"};
constexpr Alike<1> kLikeLeverArm = {"cg_offset"};
constexpr Alike<1> kLikeMotorDelay = {"sensor_delay"};  // commands late, or readings late
constexpr Alike<1> kLikeSensorDelay = {"motor_delay"};

constexpr std::array kTraits = {
    CauseTraits{.name = "payload",
                .moves_mass = true,
                .bolted_on = true,
                .implies = kOfPayload,
                .look_alikes = kLikePayload,
                .alias_of = "cg_offset"},
    CauseTraits{.name = "cg_offset", .moves_mass = true, .look_alikes = kLikeShift},
    CauseTraits{.name = "products_of_inertia", .moves_mass = true},
    CauseTraits{.name = "parameter:m", .moves_mass = true, .look_alikes = kLikeMass},
    CauseTraits{.name = "parameter:Jxx", .moves_mass = true},
    CauseTraits{.name = "parameter:Jyy", .moves_mass = true},
    CauseTraits{.name = "parameter:Jzz", .moves_mass = true},
    CauseTraits{.name = "imu_bias", .of_mounting = true, .look_alikes = kLikeBias},
    CauseTraits{.name = "imu_lever_arm", .of_mounting = true, .look_alikes = kLikeLeverArm},
    CauseTraits{.name = "imu_misalignment", .of_mounting = true, .look_alikes = kLikeTurnedImu},
    CauseTraits{.name = "battery_sag", .of_drive = true, .of_battery = true},
    CauseTraits{.name = "thrust_curve", .of_drive = true},
    CauseTraits{
        .name = "motor_delay", .of_motors = true, .between_rows = true, .look_alikes = kLikeMotorDelay},
    CauseTraits{.name = "sensor_delay", .look_alikes = kLikeSensorDelay},
    CauseTraits{.name = "parameter:kT", .look_alikes = kLikeThrust},
    CauseTraits{.name = "motor_asymmetry", .of_motors = true, .between_rows = true},
    CauseTraits{.name = "parameter:omega_m", .of_motors = true, .of_lag = true, .between_rows = true},
    CauseTraits{.name = "parameter:zeta_m", .of_motors = true, .of_lag = true, .between_rows = true},
    CauseTraits{.name = "parameter:km", .of_motors = true},
    CauseTraits{.name = "parameter:dead_time", .between_rows = true},
    CauseTraits{.name = "parameter:Jp", .between_rows = true},
    CauseTraits{.name = "rotor_mismatch", .per_rotor = true, .look_alikes = kLikeMismatch},
    CauseTraits{.name = "rotor_tilt", .per_rotor = true, .look_alikes = kLikeTilt},
    CauseTraits{.name = "rotor_drag", .carries_air = true},
    CauseTraits{.name = "parasitic_drag", .carries_air = true},
    CauseTraits{.name = "blade_flapping", .implies = kOfFlapping, .look_alikes = kOfFlapping},
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
