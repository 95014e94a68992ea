// Writes vehicle and parameter files, every number in the shortest text that reads back as the same double.
#include "ident/io/vehicle/vehicle_write.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/io/file/write_file.h"
#include "ident/io/vehicle/parameter_names.h"
#include "ident/io/vehicle/vehicle_correlations.h"

namespace ident {
namespace {

std::string number(double value) { return fmt::format("{}", value); }

std::string known_text(const Known& known) {
  if (!known.std) return number(known.value);
  return fmt::format("{{value: {}, std: {}}}", known.value, *known.std);
}

std::string vector_text(const Eigen::Vector3d& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

bool same_rotors(const std::vector<Rotor>& a, const std::vector<Rotor>& b) {
  return std::ranges::equal(a, b, [](const Rotor& p, const Rotor& q) {
    return p.r_B == q.r_B && p.a_B == q.a_B && p.s == q.s && p.slant_B == q.slant_B;
  });
}

std::string rotor_list(const std::vector<Rotor>& rotors) {
  std::string out = "rotors:\n";
  for (const Rotor& rotor : rotors)
    out += fmt::format("  - {{position: {}, axis: {}, spin: {}}}\n", vector_text(rotor.r_B),
                       vector_text(rotor.a_B), rotor.s > 0 ? "ccw" : "cw");
  return out;
}

/// Geometry, and whether the rotors were written with axes (then the slant angle is theirs).
std::string geometry(const Vehicle& vehicle, bool& axes_written) {
  std::string out;
  if (vehicle.has("l"))
    out += fmt::format("arm: {}\n", known_text(vehicle.parameters.at("l")));
  else if (vehicle.arm)
    out += fmt::format("arm: {}\n", *vehicle.arm);
  const bool by_layout =
      !vehicle.layout.empty() && vehicle.arm &&
      same_rotors(vehicle.rotors, layout_rotors(vehicle.layout, *vehicle.arm, slant_angle(vehicle)));
  if (by_layout) return out + fmt::format("layout: {}\n", vehicle.layout);
  axes_written = !vehicle.rotors.empty();
  return axes_written ? out + rotor_list(vehicle.rotors) : out;
}

std::string parameter_lines(std::map<std::string, Known> parameters, bool axes_written) {
  for (const char* own_key : {"m", "l"}) parameters.erase(own_key);
  if (axes_written) parameters.erase("alpha");
  std::string out;
  for (const FileParameter& entry : to_file(parameters))
    out += fmt::format("  {}: {}\n", entry.name, entry.word.empty() ? known_text(entry.known) : entry.word);
  return out.empty() ? out : "parameters:\n" + out;
}

// Coordinates in which estimates go together: logarithms of what is positive by its nature.
bool in_logarithms(const Parameter& p, double other) {
  return p.value > 0 && other > 0 && p.name.find('.') == std::string::npos && p.name != "dead_time" &&
         p.name != "Omega_0";
}

double spread_of(const Parameter& p, double other) {
  return in_logarithms(p, other) ? p.std / p.value : p.std;
}

double shifted(const Parameter& p, double by) {
  if (by == 0.0) return p.value;
  return in_logarithms(p, p.value) ? p.value * std::exp(by) : p.value + by;
}

// What is stored belongs to values of which some go back to what was stated: each moves to its mean given
// those, C_sb C_bb^-1 (stated - found), so that the whole predicts as the fit does as far as it can.
Eigen::VectorXd moved_with(const std::vector<const Parameter*>& stored,
                           const std::vector<const Parameter*>& back, const Correlation& correlation) {
  const auto n = static_cast<Eigen::Index>(stored.size()), m = static_cast<Eigen::Index>(back.size());
  if (m == 0 || n == 0) return Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd among(m, m), across(n, m);
  Eigen::VectorXd by(m), spread(n);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Parameter& p = *back[static_cast<std::size_t>(i)];
    const double stated = *p.prior_value;
    by[i] = (in_logarithms(p, stated) ? std::log(stated / p.value) : stated - p.value) / spread_of(p, stated);
    for (Eigen::Index k = 0; k < m; ++k)
      among(i, k) = correlation.of(p.name, back[static_cast<std::size_t>(k)]->name);
    for (Eigen::Index k = 0; k < n; ++k)
      across(k, i) = correlation.of(stored[static_cast<std::size_t>(k)]->name, p.name);
  }
  among.diagonal().array() += 1e-6;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Parameter& p = *stored[static_cast<std::size_t>(k)];
    spread[k] = spread_of(p, p.value);
  }
  const Eigen::VectorXd out = spread.cwiseProduct(Eigen::VectorXd(across * among.ldlt().solve(by)));
  return out.allFinite() ? out : Eigen::VectorXd::Zero(n);
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out + "\"";
}

std::string vehicle_to_yaml(const Vehicle& vehicle) {
  std::string out;
  if (!vehicle.name.empty()) out += fmt::format("name: {}\n", quoted(vehicle.name));
  out += fmt::format("gravity: {}\n", vehicle.g);
  if (vehicle.has("m")) out += fmt::format("mass: {}\n", known_text(vehicle.parameters.at("m")));
  if (vehicle.command)
    out += fmt::format("command: {{min: {}, max: {}}}\n", vehicle.command->min_us, vehicle.command->max_us);
  bool axes_written = false;
  out += geometry(vehicle, axes_written);
  if (vehicle.propeller_radius) out += fmt::format("propeller_radius: {}\n", *vehicle.propeller_radius);
  if (vehicle.air_density) out += fmt::format("air_density: {}\n", *vehicle.air_density);
  if (vehicle.battery_voltage) out += fmt::format("battery_voltage: {}\n", *vehicle.battery_voltage);
  if (vehicle.air) out += fmt::format("air: {}\n", word_of(*vehicle.air));
  if (vehicle.ground_z != 0.0) out += fmt::format("ground: {}\n", vehicle.ground_z);
  if (vehicle.signs == Signs::as_published) out += "signs: as_published\n";
  out += parameter_lines(vehicle.parameters, axes_written);
  return out + correlation_lines(
                   vehicle, axes_written ? std::vector<std::string>{"alpha"} : std::vector<std::string>{});
}

void write_vehicle(const std::string& path, const Vehicle& vehicle) {
  write_whole(path, vehicle_to_yaml(vehicle));
}

Vehicle with_parameters(Vehicle vehicle, const Vehicle& found) {
  for (const auto& [name, known] : found.parameters) vehicle.parameters[name] = known;
  const auto is_found = [&](const std::string& name) { return found.parameters.contains(name); };
  vehicle.correlation = vehicle.correlation.renewed(found.correlation, is_found);
  vehicle.warnings.insert(vehicle.warnings.end(), found.warnings.begin(), found.warnings.end());
  if (found.rotors.empty()) {
    for (Rotor& rotor : vehicle.rotors) rotor.a_B = axis_at(rotor, slant_angle(vehicle));
    return vehicle;
  }
  vehicle.rotors = found.rotors;
  vehicle.layout = found.layout;
  vehicle.arm = found.arm;
  return vehicle;
}

Vehicle with_result(Vehicle before, const Result& result) {
  std::vector<const Parameter*> stored, put_back;
  for (const Parameter& p : result.parameters) {
    if (p.name == "g" || !(is_file_parameter(p.name) || find_parameter(p.name))) continue;
    if (!std::isfinite(p.value) || !std::isfinite(p.std) || !(p.std > 0.0)) continue;
    if (p.identifiable || p.joint)
      stored.push_back(&p);
    else if (p.prior_value && p.value != *p.prior_value)
      put_back.push_back(&p);
  }
  const Eigen::VectorXd moved = moved_with(stored, put_back, result.correlation);
  std::set<std::string> names;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const Parameter& p = *stored[i];
    before.parameters[p.name] = {shifted(p, moved[static_cast<Eigen::Index>(i)]), p.std};
    names.insert(p.name);
  }
  before.correlation = before.correlation.renewed(
      result.correlation, [&](const std::string& name) { return names.contains(name); });
  return before;
}

}  // namespace ident
