// A whole new SDF model with a base link, rotor links, joints and motor plugins.
#include "ident/io/simulators/sdf/gazebo_page.h"

#include <fmt/format.h>

#include "ident/io/simulators/mjcf/mjcf_model.h"

namespace ident {
namespace {

std::string key(std::size_t n, const char* part) { return fmt::format("rotor{}.{}", n + 1, part); }

std::string element(const Values& values, const std::string& name, const std::string& tag, int indent) {
  return fmt::format("{:{}}<{}>{}</{}>\n", "", indent, tag, values.text(name), tag);
}

/// With the note only where the rotor is the first: the others say the same.
std::string noted(const Values& values, std::size_t n, const char* tag) {
  std::string line = element(values, key(n, tag), tag, 6);
  if (n == 0) line.insert(line.size() - 1, fmt::format("  <!-- {} -->", xml_text(values.note(key(n, tag)))));
  return line;
}

std::string rotor_link(const Values& values, std::size_t n) {
  std::string out = fmt::format("    <link name=\"rotor_{}\">\n", n) +
                    element(values, key(n, "pose"), "pose", 6) + "      <inertial>\n" +
                    element(values, key(n, "mass"), "mass", 8) + "        <inertia>\n";
  for (const char* moment : {"ixx", "iyy", "izz"}) out += element(values, key(n, moment), moment, 10);
  return out + fmt::format(
                   "        </inertia>\n      </inertial>\n    </link>\n    <joint name=\"rotor_{0}_joint\" "
                   "type=\"revolute\">\n      <parent>base_link</parent>\n      <child>rotor_{0}</child>\n   "
                   "   <axis>\n "
                   "       <xyz>0 0 1</xyz>\n        <limit>\n          <lower>-1e+16</lower>\n          "
                   "<upper>1e+16</upper>\n        </limit>\n      </axis>\n    </joint>\n",
                   n);
}

std::string plugin(const Values& values, const GazeboDialect& dialect, std::size_t n) {
  std::string out = fmt::format(
      "    <plugin filename=\"{1}\" name=\"{2}\">\n      <jointName>rotor_{0}_joint</jointName>\n      "
      "<linkName>rotor_{0}</linkName>\n      <motorNumber>{0}</motorNumber>\n      "
      "<motorType>velocity</motorType>\n",
      n, dialect.filename,
      dialect.relative_airspeed ? fmt::format("rotor_{}_motor_model", n) : std::string(dialect.name));
  out += dialect.relative_airspeed
             ? "      <robotNamespace/>\n      "
               "<commandSubTopic>/gazebo/command/motor_speed</commandSubTopic>\n" +
                   fmt::format("      <motorSpeedPubTopic>/motor_speed/{}</motorSpeedPubTopic>\n", n)
             : "      <commandSubTopic>command/motor_speed</commandSubTopic>\n";
  out += element(values, key(n, "turningDirection"), "turningDirection", 6);
  for (const char* tag : {"timeConstantUp", "timeConstantDown", "maxRotVelocity", "motorConstant",
                          "momentConstant", "rotorDragCoefficient"})
    out += noted(values, n, tag);
  if (dialect.relative_airspeed) out += noted(values, n, "maxRelativeAirspeed");
  return out +
         "      <rollingMomentCoefficient>0</rollingMomentCoefficient>\n      "
         "<rotorVelocitySlowdownSim>10</rotorVelocitySlowdownSim>\n    </plugin>\n";
}

}  // namespace

std::string gazebo_page(const Vehicle& v, const Values& values, const GazeboDialect& dialect) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {}, written by ident. Forward, left, up. -->\n"
      "<sdf version=\"1.6\">\n  <model name=\"{}\">\n    <link name=\"base_link\">\n      <inertial>\n",
      xml_text(values.source), v.name.empty() ? "vehicle" : xml_text(v.name));
  out += element(values, "base.inertial", "pose", 8) + element(values, "base.mass", "mass", 8);
  out.insert(out.size() - 1, fmt::format("  <!-- {} -->", xml_text(values.note("base.mass"))));
  out += "        <inertia>\n";
  for (const char* moment : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
    out += element(values, std::string("base.") + moment, moment, 10);
    out.insert(out.size() - 1,
               fmt::format("  <!-- {} -->", xml_text(values.note(std::string("base.") + moment))));
  }
  out += "        </inertia>\n      </inertial>\n    </link>\n";
  for (std::size_t n = 0; n < v.rotors.size(); ++n) out += rotor_link(values, n);
  for (std::size_t n = 0; n < v.rotors.size(); ++n) out += plugin(values, dialect, n);
  return out + "  </model>\n</sdf>\n";
}

}  // namespace ident
