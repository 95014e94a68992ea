// What thrust sweeps, motor steps and pendulum files hold, with the spellings of common exports:
// RCbenchmark 15xx ("Motor Optical Speed (RPM)", "ESC signal (us)"), 1780 ("ESC (us)") and AutoQuad ESC32
// logs ("Duty", "Batt. Volts").

#include "ident/io/csv/table_schemas.h"

namespace ident {
namespace {

using enum Dimension;

constexpr double kFastestRotor = 6500.0;     // rad/s, 62,000 rpm
constexpr double kFullCommandSchemas = 1.5;  // a command of 50 % more than all there is was given in percent
constexpr double kLongestPulseSchemas = 3000.0;  // us

const Signal kTime = {"t", time, {{"time", ""}, {"timestamp", ""}, {"time s", ""}, {"t s", ""}}};
const Signal kRotorSpeed = {
    "omega", angular_rate, {{"rpm", "rpm"}, {"rotor speed", ""}, {"rotation speed", "rpm"}}, kFastestRotor};
const Signal kElectricalSpeed = {
    "omega_electrical", angular_rate, {{"motor electrical speed", "rpm"}}, kFastestRotor};
const Signal kOpticalSpeed = {"omega_optical", angular_rate, {{"motor optical speed", "rpm"}}, kFastestRotor};
const Signal kCommand = {
    "delta", fraction, {{"throttle", ""}, {"duty", "%"}, {"duty cycle", "%"}}, kFullCommandSchemas};
const Signal kPulse = {"u",
                       pulse_width,
                       {{"esc signal", ""}, {"esc", ""}, {"pulse width", ""}, {"pwm", ""}},
                       kLongestPulseSchemas};
const Signal kVoltage = {
    "voltage", voltage, {{"batt. volts", ""}, {"battery voltage", ""}, {"motor volts", ""}}, 150.0};

const std::vector<std::vector<std::string>> kAnySpeed = {{"omega"}, {"omega_electrical"}, {"omega_optical"}};

}  // namespace

TableSchema thrust_schema() {
  return {.kind = "thrust sweep",
          .signals = {kRotorSpeed,
                      kElectricalSpeed,
                      kOpticalSpeed,
                      {"thrust", force, {}, 3000.0},
                      {"torque", torque, {}, 300.0},
                      kCommand,
                      kPulse,
                      kVoltage,
                      {"current", current, {{"amps", ""}}, 2000.0},
                      kTime},
          .text = {},
          .required = {kAnySpeed, {{"thrust"}}},
          .propeller_coefficients = true};
}

TableSchema motor_schema() {
  return {.kind = "motor step",
          .signals = {kTime, kCommand, kPulse, kRotorSpeed, kElectricalSpeed, kOpticalSpeed, kVoltage},
          .text = {},
          .required = {{{"t"}}, {{"delta"}, {"u"}}, kAnySpeed},
          .time_ordered = true};
}

TableSchema pendulum_schema() {
  return {.kind = "pendulum",
          .signals = {{"period", time, {}, 100.0},
                      {"time", time, {}, 1e5},
                      {"oscillations", number, {}, 1e5},
                      {"mass", mass, {}, 200.0},
                      {"radius", length, {}, 10.0},
                      {"length", length, {}, 50.0},
                      {"offset", length, {}, 10.0},
                      {"amplitude", angle, {}, 3.2},
                      {"std", time, {}, 100.0}},
          .text = {{"axis", {"x", "y", "z", "platform"}}},
          .required = {
              {{"axis"}}, {{"period"}, {"time", "oscillations"}}, {{"mass"}}, {{"radius"}}, {{"length"}}}};
}

}  // namespace ident
