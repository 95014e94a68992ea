// Which constants are stated, watched or found, by name.
#include "ident/flight/fit/unstated_constants.h"

namespace ident {
namespace {

constexpr double kHeldUnstated =
    1e-6;  // of the unit step, which is a tenth of the speed at hover, 5 ms, 1 % of J
// Effects that are the same as a constant.
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
    held.prior_value = held.start, held.prior_std = kHeldUnstated * held.scale;
    constants.push_back(held);
  }
}

void warn_of_found(const std::vector<std::string>& found, Result& result) {
  if (is_in(found, kOffset))
    result.warn("command_offset",
                "The logs contradict rotor speeds proportional to the command, by 5 standard deviations. "
                "Omega_0, the speed that the flown line gives at command 0, is estimated too. State it from "
                "a bench, and weigh the vehicle: a wrong mass or kT looks the same.");
  if (is_in(found, kDeadTime))
    result.warn(
        "dead_time",
        "The logs contradict motors without a dead time, by 5 standard deviations, and none is stated. "
        "dead_time is estimated too, and includes any difference of the clocks. State it from a bench.");
  if (is_in(found, kRotor))
    result.warn("rotor_inertia",
                "The logs contradict rotors without inertia, by 4 standard deviations, and Jp is not stated. "
                "Jp is estimated too, and Jzz and kQ depend on it. State Jp of propeller and bell.");
}

}  // namespace ident
