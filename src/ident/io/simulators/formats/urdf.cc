// URDF of gym-pybullet-drones: `properties`, base_link and the links of four propellers.
//
// kf and km are per squared rpm; forward, left, up; motors follow at once; spins -,+,-,+ of the yaw moment (z
// up).
//   drag = coeff times the sum of the rotors' speeds times velocity; near the ground T (1 + gnd_eff_coeff
//   (R/4h)^2)
#include <numbers>

#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/mjcf/mjcf_model.h"
#include "ident/io/simulators/readers/xml_document.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

constexpr double kPerRpmUrdf = std::numbers::pi / 30.0;  // rad/s
const std::vector<FixedRotor> kLayoutUrdf = {{1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, -1}};

std::string hub(std::size_t n) { return fmt::format("prop{}.xyz", n); }

bool recognises(std::string_view text) {
  return text.find("<robot") != std::string_view::npos && text.find("<properties") != std::string_view::npos;
}

Fields read(const std::string& text, const std::string& file) {
  const XmlDocument document(text, file);
  const pugi::xml_node root = document.root(), properties = root.child("properties");
  if (!properties) document.fail(root, "has no properties of gym-pybullet-drones");
  Fields fields(text, file);
  for (const pugi::xml_attribute attribute : properties.attributes())
    document.add_numbers(fields, attribute.name(), attribute);
  const pugi::xml_node base = root.find_child_by_attribute("link", "name", "base_link");
  const pugi::xml_node inertial = base.child("inertial"), inertia = inertial.child("inertia");
  if (!inertial || !inertia) document.fail(base ? base : root, "has no base_link with an inertial");
  document.add_numbers(fields, "mass", inertial.child("mass").attribute("value"));
  for (const char* name : {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"})
    document.add_numbers(fields, name, inertia.attribute(name));
  for (std::size_t n = 0; n < 4; ++n) {
    const std::string name = fmt::format("prop{}_link", n);
    const pugi::xml_node link = root.find_child_by_attribute("link", "name", name.c_str());
    if (!link) document.fail(root, fmt::format("has no link '{}'", name));
    document.add_numbers(fields, hub(n), link.child("inertial").child("origin").attribute("xyz"));
    if (!fields.has(hub(n))) document.fail(link, "has no inertial with an origin, where its thrust acts");
  }
  return fields;
}

Vehicle vehicle(const Fields& f) {
  Vehicle v;
  for (std::size_t n = 0; n < 4; ++n)
    v.rotors.push_back({.r_B = flipped(f.vector3(hub(n))), .s = kLayoutUrdf[n].spin});
  MassProperties body{.m = f.positive("mass")};
  body.J.diagonal() << f.positive("ixx"), f.positive("iyy"), f.positive("izz");
  set_mass_properties(v, body);
  for (const char* product : {"ixy", "ixz", "iyz"})
    if (f.number(product, 0.0) != 0.0)
      assume(v, f, "products of inertia are ignored, as gym-pybullet-drones does");
  v.g = 9.8;  // BaseAviary.G
  v.parameters["kT"] = {f.positive("kf") / (kPerRpmUrdf * kPerRpmUrdf), {}};
  v.parameters["kQ"] = {f.positive("km") / (kPerRpmUrdf * kPerRpmUrdf), {}};
  v.parameters["km"] = {
      as_stated(std::sqrt(f.positive("thrust2weight") * body.m * v.g / (4 * v.value("kT")))), {}};
  state_unless_zero(v, "rotor_drag.kd", f.number("drag_coeff_xy", 0.0));
  state_unless_zero(v, "axial_inflow.kz", f.number("drag_coeff_z", 0.0));
  v.propeller_radius = f.positive("prop_radius");
  state_unless_zero(v, "ground_effect.radius_sq",
                    f.number("gnd_eff_coeff", 0.0) * *v.propeller_radius * *v.propeller_radius);
  assume(
      v, f,
      "rotors in the order and with the spins of cf2x; the command is taken as linear from 0 to the speed of "
      "thrust2weight");
  return v;
}

/// The file needs a radius of the propeller; without one half the arm serves, and ground effect goes by it.
void stand_in(const Vehicle&, Vehicle& v) {
  v.g = 9.8;
  if (!v.propeller_radius)
    v.propeller_radius = as_stated(std::hypot(v.rotors[0].r_B.x(), v.rotors[0].r_B.y()) / 2);
}

std::vector<Value> values(const Vehicle& v, const Fields* own) {
  const double most = full_speed(v), kT = v.value("kT"), m = v.value("m");
  const double radius = v.propeller_radius.value();
  double arm = std::hypot(v.rotors[0].r_B.x(), v.rotors[0].r_B.y());
  if (own) {  // the arm of a user's file may be rounded: it changes as the hubs do
    const Eigen::Vector3d theirs = own->vector3(hub(0));
    arm *= own->number("arm") / std::hypot(theirs.x(), theirs.y());
  }
  const double ground = value_or_zero(v, "ground_effect.radius_sq");
  std::vector<Value> out = {
      {"arm", {arm}, "m", "hubs"},
      {"kf", {kT * kPerRpmUrdf * kPerRpmUrdf}, "N/rpm^2", "kT"},
      {"km", {v.value("kQ") * kPerRpmUrdf * kPerRpmUrdf}, "N m/rpm^2", "kQ"},
      {"thrust2weight", {4 * kT * most * most / (m * v.g)}, "-", "kT (Omega_0 + km)^2 over m g"},
      {"gnd_eff_coeff", {ground / (radius * radius)}, "-", "ground_effect.radius^2/R^2"},
      {"prop_radius", {radius}, "m", "propeller_radius"},
      {"drag_coeff_xy", {value_or_zero(v, "rotor_drag.kd")}, "kg/rad", "rotor_drag.kd"},
      {"drag_coeff_z", {value_or_zero(v, "axial_inflow.kz")}, "kg/rad", "axial_inflow.kz"},
      {"mass", {m}, "kg", "m"},
      {"ixx", {v.value("Jxx")}, "kg m^2", "Jxx"},
      {"iyy", {v.value("Jyy")}, "kg m^2", "Jyy"},
      {"izz", {v.value("Jzz")}, "kg m^2", "Jzz"}};
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    const Eigen::Vector3d r = flipped(v.rotors[n].r_B);
    out.push_back({hub(n), {r.x(), r.y(), r.z()}, "m", "hub"});
  }
  return out;
}

std::string page(const Vehicle& v, const Values& values) {
  std::string notes, properties, links;
  for (const char* name : {"arm", "kf", "km", "thrust2weight", "gnd_eff_coeff", "prop_radius",
                           "drag_coeff_xy", "drag_coeff_z", "mass", "ixx", "iyy", "izz"})
    notes += fmt::format("       {}: {}\n", name, values.note(name));
  // The reader of gym-pybullet-drones goes by position: properties first, then base_link, its inertial first.
  properties = fmt::format(
      "  <properties arm=\"{}\" kf=\"{}\" km=\"{}\" thrust2weight=\"{}\" max_speed_kmh=\"30\" "
      "gnd_eff_coeff=\"{}\" "
      "prop_radius=\"{}\" drag_coeff_xy=\"{}\" drag_coeff_z=\"{}\" dw_coeff_1=\"0\" dw_coeff_2=\"1\" "
      "dw_coeff_3=\"1\"/>\n",
      values.text("arm"), values.text("kf"), values.text("km"), values.text("thrust2weight"),
      values.text("gnd_eff_coeff"), values.text("prop_radius"), values.text("drag_coeff_xy"),
      values.text("drag_coeff_z"));
  const auto massless = [](const std::string& name, const std::string& xyz) {
    return fmt::format(
        "  <link name=\"{0}\">\n    <inertial>\n      <origin rpy=\"0 0 0\" xyz=\"{1}\"/>\n      <mass "
        "value=\"0\"/>\n      "
        "<inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/>\n    </inertial>\n  "
        "</link>\n  <joint "
        "name=\"{0}_joint\" type=\"fixed\">\n    <parent link=\"base_link\"/>\n    <child link=\"{0}\"/>\n  "
        "</joint>\n",
        name, xyz);
  };
  for (std::size_t n = 0; n < 4; ++n) links += massless(fmt::format("prop{}_link", n), values.text(hub(n)));
  links += massless("center_of_mass_link", "0 0 0");
  const double arm = values.number("arm");
  return fmt::format(
      "<?xml version=\"1.0\" ?>\n<robot name=\"{}\">\n  <!-- Written by ident for gym-pybullet-drones.\n{}  "
      "-->\n{}"
      "  <link name=\"base_link\">\n    <inertial>\n      <origin rpy=\"0 0 0\" xyz=\"0 0 0\"/>\n      <mass "
      "value=\"{}\"/>\n"
      "      <inertia ixx=\"{}\" ixy=\"0.0\" ixz=\"0.0\" iyy=\"{}\" iyz=\"0.0\" izz=\"{}\"/>\n    "
      "</inertial>\n"
      "    <collision>\n      <origin rpy=\"0 0 0\" xyz=\"0 0 0\"/>\n      <geometry>\n        <cylinder "
      "radius=\"{}\" "
      "length=\"{}\"/>\n      </geometry>\n    </collision>\n  </link>\n{}</robot>\n",
      v.name.empty() ? "vehicle" : xml_text(v.name), notes, properties, values.text("mass"),
      values.text("ixx"), values.text("iyy"), values.text("izz"), value_text(arm), value_text(0.4 * arm),
      links);
}

std::vector<std::string> remarks(const Vehicle& whole, const Vehicle& v) {
  std::vector<std::string> out;
  if (v.has("rotor_drag.kd") || v.has("axial_inflow.kz"))
    out.push_back(
        "drag acts at the centre of gravity there, not at the hubs: the damping of the rates is missing");
  if (whole.g != 9.8)
    out.push_back(
        fmt::format("gym-pybullet-drones computes with 9.8 m/s^2, the vehicle says {:.6g}", whole.g));
  if (v.has("ground_effect.radius_sq")) {
    out.push_back("ground effect agrees to first order in (radius/4 height)^2");
  }
  if (!whole.propeller_radius)
    out.push_back(
        fmt::format("the vehicle file states no propeller_radius: {:.3g} m, half the arm, is written",
                    *v.propeller_radius));
  return out;
}

}  // namespace

SimulatorFormat urdf_format() {
  return {.target = "urdf",
          .meaning = "gym-pybullet-drones: a URDF with its properties",
          .holds = {.products = false,
                    .centre = Capacity::Centre::none,
                    .tilted_axes = false,
                    .motor = Capacity::Motor::instant,
                    .layout = kLayoutUrdf,
                    .constants = {"rotor_drag.kd", "axial_inflow.kz", "ground_effect.radius_sq"},
                    .needs = {"km"}},
          .recognises = recognises,
          .read = read,
          .vehicle = vehicle,
          .stand_in = stand_in,
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
