// Finds free body, sites and actuators; attributes come from the element, its class or the defaults.
#include "ident/io/simulators/mjcf/mjcf_model.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "ident/core/error.h"
#include "ident/io/simulators/readers/xml_document.h"

namespace ident {
namespace {

pugi::xml_node child_of_class(pugi::xml_node root, const std::string& name, const std::string& element) {
  for (const pugi::xml_node defaults : elements_below(root, "default")) {
    const std::string own = defaults.attribute("class").as_string("main");
    if (own == name && defaults.child(element.c_str())) return defaults.child(element.c_str());
  }
  return {};
}

/// An attribute of an element, of its class, or of the main class.
pugi::xml_attribute attribute(pugi::xml_node root, pugi::xml_node element, const char* name) {
  if (const pugi::xml_attribute own = element.attribute(name)) return own;
  const std::string kind = element.name(), of_class = element.attribute("class").as_string();
  if (!of_class.empty())
    if (const pugi::xml_attribute found = child_of_class(root, of_class, kind).attribute(name)) return found;
  return child_of_class(root, "main", kind).attribute(name);
}

pugi::xml_node free_body(const XmlDocument& document) {
  for (const pugi::xml_node body : elements_below(document.root(), "body")) {
    if (body.child("freejoint")) return body;
    for (const pugi::xml_node joint : body.children("joint"))
      if (std::string_view(joint.attribute("type").value()) == "free") return body;
  }
  document.fail(document.root(), "has no body with a free joint: no vehicle");
}

void add_body(const XmlDocument& document, pugi::xml_node body, Fields& fields) {
  const pugi::xml_node inertial = body.child("inertial");
  if (!inertial) document.fail(body, "has no inertial: state mass and inertia, not shapes with a density");
  for (const pugi::xml_node other : elements_below(body, "inertial"))
    if (other != inertial) document.fail(other, "a second body has mass: one rigid body is read");
  const auto add = [&](const char* name, const char* field) {
    document.add_numbers(fields, field, inertial.attribute(name));
  };
  add("mass", "mass"), add("pos", "inertial.pos"), add("quat", "inertial.quat");
  add("diaginertia", "diaginertia"), add("fullinertia", "fullinertia");
  if (!fields.has("diaginertia") && !fields.has("fullinertia"))
    document.fail(inertial, "has neither diaginertia nor fullinertia");
}

pugi::xml_node site_of(const XmlDocument& document, pugi::xml_node body, pugi::xml_node actuator,
                       pugi::xml_attribute name) {
  for (const pugi::xml_node site : elements_below(body, "site"))
    if (std::string_view(site.attribute("name").value()) == name.value()) {
      if (site.parent() != body)
        document.fail(site, "lies on a body within the vehicle: sites of the free body are read");
      return site;
    }
  document.fail(actuator, fmt::format("acts at site '{}', which is not on the free body", name.value()));
}

}  // namespace

Fields mjcf_fields(const std::string& text, const std::string& file) {
  const XmlDocument document(text, file);
  const pugi::xml_node root = document.root();
  if (std::string_view(root.name()) != "mujoco") document.fail(root, "is no MJCF: the root has to be mujoco");
  Fields fields(text, file);
  const pugi::xml_node body = free_body(document);
  add_body(document, body, fields);
  document.add_numbers(fields, "gravity", root.child("option").attribute("gravity"));
  int rotor = 0;
  for (const pugi::xml_node actuator : root.child("actuator").children()) {
    const pugi::xml_attribute at = attribute(root, actuator, "site");
    if (!at) continue;
    const std::string key = fmt::format("rotor{}.", ++rotor);
    const pugi::xml_node site = site_of(document, body, actuator, at);
    for (const char* name : {"pos", "zaxis", "quat"})
      document.add_numbers(fields, key + name, attribute(root, site, name));
    if (attribute(root, site, "euler")) document.fail(site, "is turned by euler: give zaxis or quat");
    if (!fields.has(key + "pos")) document.fail(site, "has no pos");
    for (const char* name : {"gear", "ctrlrange", "dynprm"})
      document.add_numbers(fields, key + name, attribute(root, actuator, name));
    if (!fields.has(key + "gear")) document.fail(actuator, "has no gear");
    if (!fields.has(key + "ctrlrange"))
      document.fail(actuator, "has no ctrlrange: the thrust at full command is not known");
  }
  if (rotor == 0) document.fail(root, "has no actuator at a site: no rotors");
  if (rotor > 8) document.fail(root, "has more than 8 actuators at sites");
  return fields;
}

Eigen::Matrix3d mjcf_inertia(const Fields& fields) {
  Eigen::Matrix3d J;
  if (fields.has("fullinertia")) {
    const std::vector<double> v = fields.numbers("fullinertia", 6);
    J << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  } else {
    J = fields.vector3("diaginertia").asDiagonal();
  }
  if (!fields.has("inertial.quat")) return J;
  const std::vector<double> q = fields.numbers("inertial.quat", 4);
  const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
  if (!(turn.norm() > 1e-9)) fields.fail("inertial.quat", "is no rotation");
  const Eigen::Matrix3d R = turn.normalized().toRotationMatrix();
  return R * J * R.transpose();
}

Eigen::Vector3d mjcf_axis(const Fields& fields, const std::string& prefix) {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  if (fields.has(prefix + "zaxis")) axis = fields.vector3(prefix + "zaxis");
  if (fields.has(prefix + "quat")) {
    const std::vector<double> q = fields.numbers(prefix + "quat", 4);
    axis = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized() * axis;
  }
  if (!(axis.norm() > 1e-9)) fields.fail(prefix + "zaxis", "has no direction");
  return axis.normalized();
}

std::string xml_text(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool ends_a_comment = c == '-' && out.ends_with('-');
    if (std::string_view("<>&\"'").find(c) == std::string_view::npos &&
        static_cast<unsigned char>(c) >= 0x20 && !ends_a_comment)
      out += c;
  }
  return out;
}

}  // namespace ident
