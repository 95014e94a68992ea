// MATLAB: everything that is known of a vehicle as a struct with standard deviations; nothing is lost.
#include "ident/effects/all_parameters.h"
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

std::vector<Value> values(const Vehicle& v, const Fields*) {
  std::vector<Value> out = {{"g", {v.g}, "m/s^2", "gravity"}};
  for (const auto& [name, known] : v.parameters)
    out.push_back({name, {known.value}, parameter_unit(name), name});
  std::vector<double> places, axes, spins;
  for (const Rotor& r : v.rotors) {
    const Eigen::Vector3d a = axis_at(r, slant_angle(v));
    places.insert(places.end(), {r.r_B.x(), r.r_B.y(), r.r_B.z()}),
        axes.insert(axes.end(), {a.x(), a.y(), a.z()});
    spins.push_back(r.s);
  }
  out.push_back({"rotor_positions", places, "m", "a row a rotor; forward, right, down"});
  out.push_back({"rotor_axes", axes, "-", "a row a rotor"});
  out.push_back({"rotor_spins", spins, "-", "1 counter-clockwise from above"});
  return out;
}

/// Name of a field: `rotor_mismatch.ratio@2` becomes rotor_mismatch.ratio_2.
std::string field(std::string name) {
  for (char& c : name)
    if (c == '@') c = '_';
  return name;
}

std::string page(const Vehicle& v, const Values& values) {
  std::string out =
      fmt::format("% {}, written by ident. SI units; forward, right, down; names as in the vehicle file.\n",
                  values.source);
  for (std::size_t i = 0; i < values.all().size(); ++i) {
    const Value& value = values.all()[i];
    std::string text = values.text(value.name, ", ");
    if (value.name.starts_with("rotor_") && value.numbers.size() == 3 * v.rotors.size() &&
        value.name.find('.') == std::string::npos) {
      text.clear();
      for (std::size_t k = 0; k < value.numbers.size(); ++k)
        text += (k == 0 ? "" : k % 3 ? ", " : "; ") + value_text(value.numbers[k]);
    }
    out += fmt::format("vehicle.{} = {};  % {}\n", field(value.name),
                       value.numbers.size() > 1 ? "[" + text + "]" : text, values.note(value.name));
    if (values.deviations[i] > 0)
      out += fmt::format("deviation.{} = {};\n", field(value.name), value_text(values.deviations[i]));
  }
  return out;
}

}  // namespace

SimulatorFormat matlab_format() {
  return {.target = "matlab",
          .meaning = "MATLAB: a script that makes a struct of everything",
          .holds = {.everything = true},
          .values = values,
          .page = page};
}

}  // namespace ident
