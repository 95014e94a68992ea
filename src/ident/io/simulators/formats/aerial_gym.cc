// aerial_gym: the control allocation and motor model of a robot's configuration, with 95 % intervals as its
// ranges.
#include <Eigen/Geometry>

#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

std::vector<Value> values(const Vehicle& v, const Fields*) {
  std::vector<double> matrix, turns;
  for (int row = 0; row < 6; ++row)
    for (const Rotor& r : v.rotors) {
      const Eigen::Vector3d a = flipped(r.a_B), M = flipped(r.r_B).cross(a) - r.s * torque_per_thrust(v) * a;
      matrix.push_back(row < 3 ? a[row] : M[row - 3]);
    }
  for (const Rotor& r : v.rotors) turns.push_back(-r.s);
  const MotorLags lags = motor_lags(v);
  return {{"num_motors", {static_cast<double>(v.rotors.size())}, "-", "rotors"},
          {"motor_directions", turns, "-", "yaw moment on the body, 1 counter-clockwise"},
          {"allocation_matrix", matrix, "-, m",
           "rows: force, then moment about the centre of gravity; forward, left, up"},
          {"motor_thrust_constant", {v.value("kT")}, "N/(rad/s)^2", "kT"},
          {"motor_time_constant_increasing", {lags.up}, "s", "2 zeta_m/omega_m + dead_time"},
          {"motor_time_constant_decreasing", {lags.down}, "s", "the same while slowing down"},
          {"max_thrust", {full_thrust(v)}, "N", "kT (Omega_0 + km)^2"},
          {"min_thrust",
           {v.value("kT") * value_or_zero(v, "Omega_0") * value_or_zero(v, "Omega_0")},
           "N",
           "kT Omega_0^2"},
          {"thrust_to_torque_ratio", {torque_per_thrust(v)}, "m", "kQ/kT"},
          {"mass", {v.value("m")}, "kg", "m, for the URDF"},
          {"inertia", {v.value("Jxx"), v.value("Jyy"), v.value("Jzz")}, "kg m^2", "for the URDF"}};
}

std::string page(const Vehicle& v, const Values& values) {
  std::string out = fmt::format(
      "# aerial_gym configuration of {}, written by ident: parts of a robot's Cfg class.\n"
      "class control_allocator_config:\n",
      values.source);
  std::string model =
      "\n    class motor_model_config:\n        use_rps = True  # constants over (rad/s)^2\n"
      "        use_discrete_approximation = False\n";
  std::string urdf;
  for (const Value& value : values.all()) {
    const std::string note = values.note(value.name);
    if (value.name == "mass" || value.name == "inertia") {
      urdf += fmt::format("# {}: {}  # {}\n", value.name, values.text(value.name), note);
    } else if (value.name == "allocation_matrix") {
      out += fmt::format("    # {}\n    allocation_matrix = [\n", note);
      for (std::size_t row = 0; row < 6; ++row) {
        out += "        [";
        for (std::size_t k = 0; k < v.rotors.size(); ++k)
          out += (k ? ", " : "") + value_text(value.numbers[row * v.rotors.size() + k]);
        out += "],\n";
      }
      out += "    ]\n";
    } else if (value.name.find("constant") != std::string::npos) {
      const auto [low, high] = values.interval(value.name);
      model += fmt::format("        # {}\n        {}_min = {}\n        {}_max = {}\n", note, value.name,
                           value_text(std::max(low, 0.0)), value.name, value_text(high));
    } else {
      const std::string text = values.text(value.name, ", ");
      const bool of_model = value.name.find("thrust") != std::string::npos;
      (of_model ? model : out) += fmt::format("{}{} = {}  # {}\n", of_model ? "        " : "    ", value.name,
                                              value.numbers.size() > 1 ? "[" + text + "]" : text, note);
    }
  }
  return out + model + urdf;
}

}  // namespace

SimulatorFormat aerial_gym_format() {
  return {.target = "aerial_gym",
          .meaning = "aerial_gym: control allocation and motor model, intervals as ranges, in Python",
          .holds = {.centre = Capacity::Centre::by_positions,
                    .up_and_down = true,
                    .idle_speed = true,
                    .needs = {"km", "omega_m"}},
          .values = values,
          .page = page};
}

}  // namespace ident
