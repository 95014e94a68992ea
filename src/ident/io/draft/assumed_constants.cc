// Scaling laws between published vehicles, for the constants that a draft starts from.
//
//                         Crazyflie 2   [Phang]   PX4's x500   here
//   propeller radius/arm     0.49        0.59        0.51      0.53
//   tip speed at full, m/s    54          -          127        90
//   kQ/(kT radius)           0.30         -          0.13      0.2
//   Jxx/(m arm^2)            0.25        0.20        0.17      0.2
//   Jzz/(m arm^2)            0.49         -          0.32      0.4
//
// They hold a fit where a flight says nothing; a flight that says something moves away from them.
#include "ident/io/draft/assumed_constants.h"

#include <fmt/format.h>

namespace ident {
namespace {

constexpr double kRadiusPerArm = 0.53, kTipSpeed = 90.0, kDragArm = 0.2;  // -, m/s, -
constexpr double kRollInertia = 0.2, kYawInertia = 0.4;                   // of m arm^2
constexpr double kHoverCommand =
    0.5;                           // at which the rotors of a common vehicle carry it, give or take a half
constexpr double kGravity = 9.81;  // m/s^2
constexpr double kMotor = 25.0;    // rad/s; published ones lie between 15 and 50

std::string line(const char* name, double value, double relative_std, const std::string& why) {
  return fmt::format("{:<78} # ASSUMED: {}\n",
                     fmt::format("  {}: {{value: {:.3g}, std: {:.3g}}}", name, value, relative_std * value),
                     why);
}

}  // namespace

std::string assumed_constants(double mass, double arm, int rotors, const CarriedWeight& carried) {
  const double radius = kRadiusPerArm * arm;
  const double command = carried.command.value_or(kHoverCommand);
  const bool both = carried.command && carried.speed;
  const double km = both ? *carried.speed / command : kTipSpeed / radius;
  const double Omega_hover = carried.speed.value_or(command * km);
  const double kT = mass * kGravity / (rotors * Omega_hover * Omega_hover);
  const double J = mass * arm * arm;
  std::string hover = "hover at half the command";
  if (carried.command)
    hover = fmt::format("carries the mass above at a command of {:.2f}, as in this log", command);
  if (carried.speed)
    hover = fmt::format("carries the mass above at {:.0f} rad/s, as in this log", Omega_hover);
  return "parameters:\n" + line("kT", kT, 1.0, "N s^2/rad^2, " + hover) +
         line("kQ", kDragArm * radius * kT, 1.0, "N m s^2/rad^2") +
         line("km", km, 0.5,
              both ? "rad/s at full command, by commands and rotor speeds of this log"
                   : "rad/s at full command, tips at 90 m/s") +
         line("omega_m", kMotor, 1.0, "rad/s") + line("zeta_m", 1.0, 0.5, "-") +
         line("Jxx", kRollInertia * J, 0.5, "kg m^2, by mass and arm") +
         line("Jyy", kRollInertia * J, 0.5, "kg m^2, by mass and arm") +
         line("Jzz", kYawInertia * J, 0.5, "kg m^2, by mass and arm");
}

}  // namespace ident
