// PX4's simulation in hardware (SIH): its parameters [PX4 sih.cpp, sih_params].
//
// Thrust T_MAX u and torque Q_MAX u of the filtered command u, linear drag -KDV v, X layout in PX4's order.
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/readers/parameter_lines.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

constexpr double kGravity = 9.80665;   // CONSTANTS_ONE_G of PX4
constexpr double kDragSpeedSih = 5.0;  // m/s at which the drag of the airframe is replaced by a linear one

bool recognises(std::string_view text) {
  return sets_parameter(text, "SIH_MASS") || sets_parameter(text, "SIH_T_MAX") ||
         sets_parameter(text, "SIH_IXX");
}

const std::vector<FixedRotor> kLayout = {{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}};

Vehicle vehicle(const Fields& f) {
  Vehicle v;
  v.g = kGravity;
  const double type = f.number("SIH_VEHICLE_TYPE", 0.0);
  if (type != 0.0) f.fail("SIH_VEHICLE_TYPE", "is no quadrotor (0), and only these are read");
  const double x = f.positive("SIH_L_PITCH"), y = f.positive("SIH_L_ROLL"), torque = f.number("SIH_Q_MAX");
  for (const FixedRotor& place : kLayout)
    v.rotors.push_back({.r_B = {place.x * x, place.y * y, 0.0}, .s = torque < 0 ? -place.spin : place.spin});
  v.parameters["m"] = {f.positive("SIH_MASS"), {}};
  for (const auto& [name, constant] : {std::pair("SIH_IXX", "Jxx"), {"SIH_IYY", "Jyy"}, {"SIH_IZZ", "Jzz"}})
    v.parameters[constant] = {f.positive(name), {}};
  for (const auto& [name, constant] : {std::pair("SIH_IXY", "Jxy"), {"SIH_IXZ", "Jxz"}, {"SIH_IYZ", "Jyz"}})
    state_unless_zero(v, constant, f.number(name, 0.0));
  set_by_full_thrust(v, f.positive("SIH_T_MAX"), std::abs(torque));
  set_first_order(v, f.number("SIH_T_TAU", 0.05), 0.0);
  for (const char* name : {"Kdx", "Kdy", "Kdz"}) state_unless_zero(v, name, f.number("SIH_KDV", 1.0));
  assume(v, f,
         fmt::format(
             "SIH knows no rotor speed: {} rad/s at full command are assumed, only kT km^2 and kQ km^2 count",
             kAssumedFullSpeed));
  assume(v, f, "SIH's thrust is linear in the command: a command here is its square root");
  if (f.number("SIH_KDW", 0.0) != 0.0)
    assume(v, f, "SIH_KDW, a damping of the rates, has no counterpart and is left out");
  return v;
}

void stand_in(const Vehicle& whole, Vehicle& v) {
  v.g = kGravity;
  set_by_full_thrust(v, full_thrust(v), full_thrust(v) * torque_per_thrust(v));
  const double drag = as_stated(whole_linear_drag(whole, kDragSpeedSih));
  for (const char* name : {"Kdx", "Kdy", "Kdz"}) {
    v.parameters.erase(name);
    state_unless_zero(v, name, drag);
  }
}

std::vector<Value> values(const Vehicle& v, const Fields*) {
  const Rotor& first = v.rotors.front();
  const double thrust = full_thrust(v);
  return {{"SIH_MASS", {v.value("m")}, "kg", "m"},
          {"SIH_IXX", {v.value("Jxx")}, "kg m^2", "Jxx"},
          {"SIH_IYY", {v.value("Jyy")}, "kg m^2", "Jyy"},
          {"SIH_IZZ", {v.value("Jzz")}, "kg m^2", "Jzz"},
          {"SIH_IXY", {value_or_zero(v, "Jxy")}, "kg m^2", "Jxy"},
          {"SIH_IXZ", {value_or_zero(v, "Jxz")}, "kg m^2", "Jxz"},
          {"SIH_IYZ", {value_or_zero(v, "Jyz")}, "kg m^2", "Jyz"},
          {"SIH_T_MAX", {thrust}, "N", "kT (Omega_0 + km)^2"},
          {"SIH_Q_MAX", {first.s * thrust * torque_per_thrust(v)}, "N m", "kQ (Omega_0 + km)^2"},
          {"SIH_L_ROLL", {std::abs(first.r_B.y())}, "m", "hubs"},
          {"SIH_L_PITCH", {std::abs(first.r_B.x())}, "m", "hubs"},
          {"SIH_KDV",
           {value_or_zero(v, "Kdx")},
           "N/(m/s)",
           "Kdx..z, rotor_drag at hover, parasitic_drag at 5 m/s"},
          {"SIH_T_TAU", {motor_lags(v).up}, "s", "2 zeta_m/omega_m + dead_time"}};
}

std::string page(const Vehicle&, const Values& values) {
  std::string out = fmt::format(
      "# PX4 SIH parameters of {}, written by ident.\n# MAV ID  COMPONENT ID  PARAM NAME  VALUE  "
      "TYPE (6: integer, 9: float)\n# The thrust of SIH is linear in the command: set THR_MDL_FAC to "
      "0 in the simulation.\n",
      values.source);
  for (const Value& value : values.all())
    out +=
        fmt::format("1\t1\t{}\t{}\t9\t# {}\n", value.name, values.text(value.name), values.note(value.name));
  return out +
         "1\t1\tSIH_KDW\t0\t9\t# N m/(rad/s); rates have no damping of their "
         "own\n1\t1\tSIH_VEHICLE_TYPE\t0\t6\t# "
         "quadrotor\n1\t1\tTHR_MDL_FAC\t0\t9\n";
}

std::vector<std::string> remarks(const Vehicle& whole, const Vehicle& v) {
  std::vector<std::string> out = {
      "thrust is linear in SIH's command, and the lag acts on it: with THR_MDL_FAC 0 in the "
      "simulation, steady flight agrees with the vehicle"};
  if (whole_linear_drag(whole, kDragSpeedSih) > 0)
    out.push_back(fmt::format(
        "all drag becomes the linear SIH_KDV {:.4g} N/(m/s): that of the rotors as at hover, that of the "
        "airframe as at {} m/s",
        value_or_zero(v, "Kdx"), kDragSpeedSih));
  return out;
}

}  // namespace

SimulatorFormat px4_sih_format() {
  return {.target = "px4-sih",
          .meaning = "PX4 SIH: a parameter file with SIH_*",
          .holds = {.centre = Capacity::Centre::none,
                    .tilted_axes = false,
                    .heights = false,
                    .layout = kLayout,
                    .constants = {"Kdx", "Kdy", "Kdz"},
                    .replaced = {"rotor_drag.kd", "parasitic_drag.C"},
                    .needs = {"km", "omega_m"},
                    .rotor_speeds = false},
          .recognises = recognises,
          .read = parameter_lines,
          .vehicle = vehicle,
          .stand_in = stand_in,
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
