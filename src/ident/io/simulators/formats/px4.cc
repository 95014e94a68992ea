// PX4's control allocation and thrust curve: CA_* and THR_MDL_FAC of an airframe, with the speeds of its
// Gazebo outputs.
//
// T = CT u^2, yaw moment KM T, KM positive for a counter-clockwise rotor; forward, right, down.
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/readers/parameter_lines.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

std::string key(std::size_t n, const char* part) { return fmt::format("CA_ROTOR{}_{}", n, part); }

bool recognises(std::string_view text) {
  return sets_parameter(text, "CA_ROTOR_COUNT") || sets_parameter(text, "CA_ROTOR0_PX");
}

std::size_t rotor_count(const Fields& f) {
  std::size_t present = 0;
  while (present < 12 && f.has(key(present, "PX"))) ++present;
  const double count = f.number("CA_ROTOR_COUNT", static_cast<double>(present));
  if (count < 1 || count > 8 || count != std::floor(count)) f.fail("CA_ROTOR_COUNT", "has to be 1 to 8");
  return static_cast<std::size_t>(count);
}

Vehicle vehicle(const Fields& f) {
  Vehicle v;
  double torque = 0.0;
  const std::size_t rotors = rotor_count(f);
  for (std::size_t n = 0; n < rotors; ++n) {
    Rotor rotor{.r_B = {f.number(key(n, "PX")), f.number(key(n, "PY")), f.number(key(n, "PZ"), 0.0)}};
    rotor.a_B = {f.number(key(n, "AX"), 0.0), f.number(key(n, "AY"), 0.0), f.number(key(n, "AZ"), -1.0)};
    if (!(rotor.a_B.norm() > 1e-6)) f.fail(key(n, "AZ"), "leaves the thrust axis without a direction");
    rotor.a_B.normalize();
    const double km = f.number(key(n, "KM"), 0.05);  // PX4's default
    rotor.s = km < 0 ? -1 : 1;
    torque += std::abs(km) / static_cast<double>(rotors);
    v.rotors.push_back(rotor);
  }
  const double most = f.number("SIM_GZ_EC_MAX1", 0.0), least = f.number("SIM_GZ_EC_MIN1", 0.0);
  if (most > 0) {
    v.parameters["km"] = {as_stated(most - least), {}};
    state_unless_zero(v, "Omega_0", least);
    const double thrust = f.number(key(0, "CT"), 0.0);
    if (thrust > 0) {
      v.parameters["kT"] = {as_stated(thrust / (most * most)), {}};
      v.parameters["kQ"] = {as_stated(torque * thrust / (most * most)), {}};
      assume(v, f, "CA_ROTOR0_CT is taken as the thrust at full command, N: PX4 needs ratios only");
    }
  }
  assume(v, f, "an airframe holds neither mass nor inertia: state them before flying this vehicle");
  return v;
}

std::vector<Value> values(const Vehicle& v, const Fields* own) {
  std::vector<Value> out = {{"CA_ROTOR_COUNT", {static_cast<double>(v.rotors.size())}, "-", "rotors"}};
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    const Rotor& r = v.rotors[n];
    const double ratio = rotor_ratio(v, n);
    constexpr const char *kHub[] = {"PX", "PY", "PZ"}, *kAxis[] = {"AX", "AY", "AZ"};
    for (int i = 0; i < 3; ++i) out.push_back({key(n, kHub[i]), {r.r_B[i]}, "m", "hub", {}, 0.0});
    for (int i = 0; i < 3; ++i)
      out.push_back({key(n, kAxis[i]), {r.a_B[i]}, "-", "thrust axis", {}, i < 2 ? 0.0 : -1.0});
    if (!own || own->has(key(0, "CT")))  // only ratios count: a file without any has equal ones
      out.push_back({key(n, "CT"), {ratio * full_thrust(v)}, "N", "kT (Omega_0 + km)^2"});
    out.push_back({key(n, "KM"), {r.s * torque_per_thrust(v)}, "m", "kQ/kT, counter-clockwise positive"});
  }
  if (own && !own->has("SIM_GZ_EC_MAX1")) return out;
  for (std::size_t n = 1; n <= v.rotors.size(); ++n) {
    out.push_back({fmt::format("SIM_GZ_EC_MIN{}", n), {value_or_zero(v, "Omega_0")}, "rad/s", "Omega_0"});
    out.push_back({fmt::format("SIM_GZ_EC_MAX{}", n), {full_speed(v)}, "rad/s", "Omega_0 + km"});
  }
  return out;
}

std::string page(const Vehicle&, const Values& values) {
  std::string out =
      fmt::format("# PX4 control allocation of {}, written by ident: lines of an airframe.\n", values.source);
  for (const Value& value : values.all())
    out += fmt::format("param set-default {} {}  # {}\n", value.name, values.text(value.name),
                       values.note(value.name));
  return out +
         "param set-default THR_MDL_FAC 1  # thrust goes with the square of the command where Omega_0 is "
         "small\n";
}

std::vector<std::string> remarks(const Vehicle&, const Vehicle&) {
  return {
      "an airframe file holds geometry and ratios: mass, inertia, lags and drag belong into the simulator's "
      "model"};
}

}  // namespace

SimulatorFormat px4_format() {
  return {.target = "px4",
          .meaning = "PX4: control allocation CA_* of an airframe",
          .holds = {.centre = Capacity::Centre::by_positions,
                    .each_rotor = true,
                    .motor = Capacity::Motor::instant,
                    .idle_speed = true,
                    .needs = {"km"}},
          .recognises = recognises,
          .read = parameter_lines,
          .vehicle = vehicle,
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
