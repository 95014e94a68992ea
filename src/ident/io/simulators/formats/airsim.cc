// AirSim: MultiRotorParams as C++, since its constants are compiled in.
//
// C_T = T/(rho n^2 D^4), C_P = P/(rho n^3 D^5) = 2 pi Q/(rho n^2 D^5), n in rev/s; forward, right, down.
#include <numbers>

#include "ident/core/error.h"
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

constexpr double kDensity = 1.225;  // kg/m^3 of AirSim at sea level
constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kDragSpeed = 5.0;  // m/s; AirSim's drag is that of a box with this coefficient

std::vector<Value> values(const Vehicle& v, const Fields*) {
  if (!v.propeller_radius) throw UsageError(v.file + ": propeller_radius: is needed to export to airsim");
  const double D = 2 * *v.propeller_radius, rho = v.air_density.value_or(kDensity);
  std::vector<Value> out = {
      {"mass", {v.value("m")}, "kg", "m"},
      {"C_T", {v.value("kT") * kTurn * kTurn / (rho * std::pow(D, 4))}, "-", "kT"},
      {"C_P", {v.value("kQ") * kTurn * kTurn * kTurn / (rho * std::pow(D, 5))}, "-", "kQ"},
      {"max_rpm", {full_speed(v) * 60 / kTurn}, "rpm", "Omega_0 + km"},
      {"propeller_diameter", {D}, "m", "propeller_radius"},
      {"control_signal_filter_tc", {motor_lags(v).up}, "s", "2 zeta_m/omega_m + dead_time, on the thrust"},
      {"linear_drag_coefficient",
       {whole_linear_drag(v, kDragSpeed)},
       "N/(m/s)",
       "all drag at 5 m/s: tune 1.3/4 by it"}};
  for (const char* J : {"Jxx", "Jyy", "Jzz"}) out.push_back({J, {v.value(J)}, "kg m^2", J});
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    const Rotor& r = v.rotors[n];
    out.push_back({fmt::format("rotor{}", n),
                   {r.r_B.x(), r.r_B.y(), r.r_B.z(), r.a_B.x(), r.a_B.y(), r.a_B.z()},
                   "m, -",
                   "hub, thrust axis"});
  }
  return out;
}

std::string page(const Vehicle& v, const Values& values) {
  std::string out =
      fmt::format("// AirSim MultiRotorParams of {}, written by ident: for setupParams().\n", values.source);
  const auto line = [&](const char* target, const char* name) {
    out += fmt::format("{} = {}f;  // {}\n", target, values.text(name), values.note(name));
  };
  line("params.mass", "mass"), line("params.rotor_params.C_T", "C_T"), line("params.rotor_params.C_P", "C_P");
  line("params.rotor_params.max_rpm", "max_rpm"),
      line("params.rotor_params.propeller_diameter", "propeller_diameter");
  line("params.rotor_params.control_signal_filter_tc", "control_signal_filter_tc");
  out += "params.rotor_params.calculateMaxThrust();\nparams.inertia = Matrix3x3r::Zero();\n";
  line("params.inertia(0, 0)", "Jxx"), line("params.inertia(1, 1)", "Jyy"),
      line("params.inertia(2, 2)", "Jzz");
  line("params.linear_drag_coefficient", "linear_drag_coefficient");
  out += "params.rotor_poses.clear();\n";
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    const std::vector<double>& p = values.at(fmt::format("rotor{}", n)).numbers;
    out += fmt::format(
        "params.rotor_poses.emplace_back(Vector3r({}f, {}f, {}f), Vector3r({}f, {}f, {}f), "
        "RotorTurningDirection::RotorTurningDirection{});\n",
        p[0], p[1], p[2], p[3], p[4], p[5], v.rotors[n].s > 0 ? "CCW" : "CW");
  }
  return out + "params.rotor_count = static_cast<uint>(params.rotor_poses.size());\n";
}

std::vector<std::string> remarks(const Vehicle&, const Vehicle&) {
  return {
      "AirSim filters the thrust, not the speed, and its drag is that of a box: match "
      "linear_drag_coefficient to the drag at 5 "
      "m/s by a test"};
}

}  // namespace

SimulatorFormat airsim_format() {
  return {.target = "airsim",
          .meaning = "AirSim: MultiRotorParams, in C++",
          .holds = {.products = false,
                    .centre = Capacity::Centre::by_positions,
                    .air_density = true,
                    .constants = {"rotor_drag.kd", "parasitic_drag.C", "Kdx", "Kdy", "Kdz"},
                    .needs = {"km", "omega_m"}},
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
