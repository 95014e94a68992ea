// By name.
#include "ident/flight/fit/unstated_constants.h"

namespace ident {
namespace {

constexpr double kHeld = 1e-6;  // of the unit step: a tenth of the speed at hover, 5 ms, a hundredth of J
// Effects that are the same.
const std::string kDelay = "motor_delay.tau", kMomentum = "gyroscopic.Jp";

}  // namespace

bool is_there(const std::string& name, const std::vector<FreeConstant>& constants, const Vehicle& vehicle) {
  const auto is_stated = [&](const std::string& of) {
    return vehicle.has(of) || std::ranges::find(constants, of, &FreeConstant::name) != constants.end();
  };
  return is_stated(name) || (name == kDeadTime && is_stated(kDelay)) ||
         (name == kRotor && is_stated(kMomentum));
}

bool asks_at_once(const std::vector<FreeConstant>& constants, const Vehicle& vehicle,
                  const FlightRecord& record) {
  const auto Jzz = std::ranges::find(constants, int{param::Jzz}, &FreeConstant::index);
  return record.signals.commands && !is_there(kRotor, constants, vehicle) && Jzz != constants.end() &&
         !Jzz->prior_std;
}

bool can_show(const std::string& name, const Signals& signals) {
  return signals.commands || (name == kRotor && signals.rotor_speeds);
}

void watch(const std::vector<std::string>& names, std::vector<FreeConstant>& constants,
           const Vehicle& vehicle, const FlightRecord& record, const std::vector<double>& p) {
  for (const std::string& name : names) {
    if (is_there(name, constants, vehicle) || !can_show(name, record.signals)) continue;
    const std::vector<FreeConstant> all = free_constants(vehicle, p, {name});
    FreeConstant held = *std::ranges::find(all, name, &FreeConstant::name);
    held.watched = true;
    held.prior_value = held.start, held.prior_std = kHeld * held.scale;
    constants.push_back(held);
  }
}

void warn_of_found(const std::vector<std::string>& found, Result& result) {
  if (is_in(found, kOffset))
    result.warn(
        "command_offset",
        "Omega_0 is estimated too, the rotors' speed at command 0 as the line through the flown commands "
        "gives it: their speed is not proportional to the command, or the mass or kT as stated is "
        "wrong");
  if (is_in(found, kDeadTime))
    result.warn("dead_time",
                "rotors follow their commands later or earlier than motors without a dead time would, and "
                "none is stated: dead_time is estimated too, with whatever commands and sensors are apart in "
                "time");
  if (is_in(found, kRotor))
    result.warn("rotor_inertia",
                "rotors that speed up turn the vehicle as they would with inertia, and none is stated: Jp is "
                "estimated too, on which Jzz and kQ depend");
}

}  // namespace ident
