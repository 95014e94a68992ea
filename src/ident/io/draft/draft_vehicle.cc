// Writes a vehicle file line by line, each with its source.
#include "ident/io/draft/draft_vehicle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/io/draft/assumed_constants.h"
#include "ident/io/draft/betaflight_geometry.h"
#include "ident/io/geometry/frame_geometry.h"

namespace ident {
namespace {

// kg per squared metre of arm: 17 for a Crazyflie 2 (0.028 kg, 0.04 m) and [Phang]'s 0.5 kg vehicle (0.17 m),
// 32 for PX4's x500 (2.0 kg, 0.25 m). A guess within a factor of two, and its deviation says so.
constexpr double kMassPerArmSquared = 25.0;
constexpr double kCrazyflie = 0.030,
                 kCrazyflieDecks = 0.010;  // kg, 27 g without decks and the battery's spread
constexpr double kCellVoltage = 3.7;       // V, of a lithium polymer cell, nominal

std::string line(const std::string& text, const std::string& comment) {
  return fmt::format("{:<78} # {}\n", text, comment);
}

FrameGeometry geometry_of(const LogStreams& log) {
  if (log.format == "crazyflie") return crazyflie_geometry();
  if (log.format.starts_with("blackbox")) return betaflight_geometry(log);
  if (const auto px4 = px4_geometry(log)) return *px4;
  if (const auto ardupilot = ardupilot_geometry(log)) return *ardupilot;
  throw DataError(
      log.file +
      ": the log does not say where the motors sit: PX4 states it from 1.13 on (CA_ROTOR*), ArduPilot by "
      "FRAME_CLASS and FRAME_TYPE of common frames; write the vehicle file by hand");
}

double mean_arm(const std::vector<Rotor>& rotors) {
  double sum = 0;
  for (const Rotor& rotor : rotors) sum += std::hypot(rotor.r_B.x(), rotor.r_B.y());
  return sum / static_cast<double>(rotors.size());
}

std::string fact(const LogStreams& log, const char* name) {
  const auto at = log.facts.find(name);
  if (at == log.facts.end()) return "";
  std::string text = at->second;
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E) c = ' ';
  return text;
}

std::string title(const LogStreams& log) {
  std::string text = fmt::format("# Drafted from {} ({}", log.file, log.format);
  for (const char* name :
       {"firmware", "Firmware revision", "Craft name", "sys_name", "ver_hw", "ver_sw", "frame", "sys_uuid"})
    if (const std::string value = fact(log, name); !value.empty())
      text += fmt::format(", {} {}", name, value);
  return text +
         ").\n# FILL IN: what a log cannot know. ASSUMED: a guess from the size of published vehicles; its "
         "std says how wide.\n";
}

std::string rotor_line(const Rotor& rotor) {
  return fmt::format("  - {{position: [{}, {}, {}], axis: [{}, {}, {}], spin: {}}}", rotor.r_B.x(),
                     rotor.r_B.y(), rotor.r_B.z(), rotor.a_B.x() + 0.0, rotor.a_B.y() + 0.0, rotor.a_B.z(),
                     rotor.s > 0 ? "ccw" : "cw");
}

/// The first of these parameters with a value above zero.
struct Stated {
  std::string name;
  double value = 0.0;
};
std::optional<Stated> stated(const LogStreams& log, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const auto value = log.parameter(name); value && *value > 0) return Stated{name, *value};
  return std::nullopt;
}

struct StatedCommand {
  Stated low, high;
};
std::optional<StatedCommand> stated_command(const LogStreams& log) {
  const auto low = stated(log, {"MOT_PWM_MIN", "PWM_MAIN_MIN1", "PWM_MAIN_MIN", "PWM_MIN", "RC3_MIN"});
  const auto high = stated(log, {"MOT_PWM_MAX", "PWM_MAIN_MAX1", "PWM_MAIN_MAX", "PWM_MAX", "RC3_MAX"});
  if (log.find("actuator_motors:0")) return std::nullopt;  // logged as 0 to 1
  if (!low || !high || low->value >= high->value) return std::nullopt;
  return StatedCommand{*low, *high};
}

std::optional<CommandRange> command_of(const LogStreams& log) {
  const auto stated = stated_command(log);
  return stated ? std::optional(CommandRange{stated->low.value, stated->high.value}) : std::nullopt;
}

std::string command_line(const LogStreams& log) {
  const auto stated = stated_command(log);
  if (!stated) return "";
  return line(fmt::format("command: {{min: {}, max: {}}}", stated->low.value, stated->high.value),
              fmt::format("us, {} and {}", stated->low.name, stated->high.name));
}

std::string battery_line(const LogStreams& log) {
  const auto cells = stated(log, {"BAT1_N_CELLS", "BAT_N_CELLS"});
  if (!cells) return "";
  return line(fmt::format("battery_voltage: {:.1f}", cells->value * kCellVoltage),
              fmt::format("V, {} cells of {} V ({})", cells->value, kCellVoltage, cells->name));
}

/// What a reader should know, and no key of the file holds.
std::string remarks(const LogStreams& log) {
  std::string text;
  if (const auto poles = stated(log, {"MOT_POLE_COUNT", "SERVO_BLH_POLES", "motor_poles"}))
    text += fmt::format(
        "# {} {}: the magnets by which speeds in the log were computed; count those of your motors.\n",
        poles->name, poles->value);
  if (const auto factor = stated(log, {"THR_MDL_FAC"}))
    text += fmt::format("# THR_MDL_FAC {:.3g}: thrust = (1 - f) u + f u^2 in the autopilot's model of it.\n",
                        factor->value);
  if (const auto expo = stated(log, {"MOT_THST_EXPO"}))
    text += fmt::format(
        "# MOT_THST_EXPO {:.3g}: thrust = (1 - e) u + e u^2 in the autopilot's model of it.\n", expo->value);
  return text;
}

bool same_place(const FrameGeometry& a, const FrameGeometry& b) {
  return std::ranges::equal(a.rotors, b.rotors,
                            [](const Rotor& x, const Rotor& y) { return x.r_B == y.r_B && x.s == y.s; });
}

}  // namespace

VehicleDraft draft_vehicle(std::span<const LogStreams> logs) {
  const LogStreams& log = logs.front();
  const FrameGeometry geometry = geometry_of(log);
  const double arm = mean_arm(geometry.rotors);
  const bool is_crazyflie = log.format == "crazyflie";
  const double mass = is_crazyflie ? kCrazyflie : std::round(kMassPerArmSquared * arm * arm * 1e3) / 1e3;
  const double mass_std = is_crazyflie ? kCrazyflieDecks : mass;
  VehicleDraft draft;
  draft.yaml = title(log);
  draft.yaml += fmt::format("name: {}_{}_rotors\n", log.format, geometry.rotors.size());
  draft.yaml += line(fmt::format("mass: {{value: {}, std: {}}}", mass, mass_std),
                     "FILL IN: kg, as it flies; this is a guess from its kind or size");
  draft.fill_in.emplace_back("mass");
  draft.yaml += command_line(log);
  draft.yaml += "rotors:\n";
  for (std::size_t i = 0; i < geometry.rotors.size(); ++i)
    draft.yaml += line(rotor_line(geometry.rotors[i]), geometry.source[i]);
  if (!geometry.arm_is_known) {
    draft.yaml += fmt::format(
        "# FILL IN: positions are for an arm of {} m, which is ASSUMED; scale them to yours (hub to "
        "centre).\n",
        format_number(arm, 3));
    draft.fill_in.emplace_back("positions of the rotors");
  }
  const CarriedWeight carried = carried_weight(log, {.rotors = geometry.rotors, .command = command_of(log)});
  draft.yaml += battery_line(log) +
                assumed_constants(mass, arm, static_cast<int>(geometry.rotors.size()), carried) +
                remarks(log);
  for (const LogStreams& other : logs.subspan(1))
    if (!same_place(geometry_of(other), geometry))
      draft.notices.push_back(
          fmt::format("{}: its parameters describe another frame than those of {}, which the "
                      "draft follows",
                      other.file, log.file));
  return draft;
}

}  // namespace ident
