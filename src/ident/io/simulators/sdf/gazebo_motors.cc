// Entries of Gazebo's motor plugins as constants of a vehicle, and back [gz-sim MulticopterMotorModel.cc].
//
// Thrust motorConstant w^2, drag torque momentConstant times thrust, -w rotorDragCoefficient v across the
// disk, speed of first order. The joint turns at w/rotorVelocitySlowdownSim: that share of the link's izz is
// the rotor's momentum.
#include "ident/io/simulators/sdf/gazebo_motors.h"

#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/sdf/sdf_model.h"

namespace ident {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kGravity = 9.8;           // m/s^2, of a world that states none
constexpr double kSlowdown = 10.0;         // rotorVelocitySlowdownSim of both plugins' models
constexpr double kNoAirspeedLimit = 1e12;  // m/s: so fast that the thrust does not fall with speed
constexpr double kLeastMomentum = 1e-6;    // Jp over Jzz: Gazebo's links cannot do without inertia
constexpr double kRounding = 1e-13;        // of the trace: what sums over links leave of a product that is 0
constexpr double kRotorMass = 1e-3;        // of the vehicle's mass, of a rotor link in a new file

std::string key(std::size_t n, const char* part) { return fmt::format("rotor{}.{}", n + 1, part); }

/// Sum over the rotors of what each plugin states, as ratios to the mean.
double mean(const Fields& f, const char* part, std::size_t rotors, double otherwise) {
  double sum = 0;
  for (std::size_t n = 0; n < rotors; ++n) sum += f.number(key(n, part), otherwise);
  return sum / static_cast<double>(rotors);
}

void read_motors(const Fields& f, std::size_t rotors, Vehicle& v) {
  for (std::size_t n = 0; n < rotors; ++n) {
    f.positive(key(n, "motorConstant")), f.positive(key(n, "momentConstant")),
        f.positive(key(n, "maxRotVelocity"));
    const std::string turn = f.word(key(n, "turningDirection"), "");
    if (turn != "ccw" && turn != "cw") f.fail(key(n, "turningDirection"), "has to be cw or ccw");
    v.rotors.push_back(
        {.r_B = flipped(sdf_hub(f, n)), .a_B = flipped(sdf_axis(f, n)), .s = turn == "ccw" ? 1 : -1});
  }
  const double kT = mean(f, "motorConstant", rotors, 0.0);
  v.parameters["kT"] = {kT, {}};
  v.parameters["kQ"] = {kT * mean(f, "momentConstant", rotors, 0.0), {}};
  for (std::size_t n = 0; n < rotors; ++n)
    if (const double ratio = as_stated(f.number(key(n, "motorConstant")) / kT); ratio != 1.0)
      v.parameters[fmt::format("rotor_mismatch.ratio@{}", n + 1)] = {ratio, {}};
  v.parameters["km"] = {mean(f, "maxRotVelocity", rotors, 0.0), {}};
  set_first_order(v, mean(f, "timeConstantUp", rotors, 1.0 / 80),
                  mean(f, "timeConstantDown", rotors, 1.0 / 40));
  state_unless_zero(v, "rotor_drag.kd", mean(f, "rotorDragCoefficient", rotors, 1e-4));
}

double slowdown_of(const Fields* own) {
  return own ? own->number(key(0, "rotorVelocitySlowdownSim"), kSlowdown) : kSlowdown;
}

/// Pose of a rotor link, and in a new file its weight: a thin disk that weighs next to nothing.
void add_link(const Vehicle& v, const Fields* own, std::size_t n, std::vector<Value>& out) {
  const Vector3d r = flipped(v.rotors[n].r_B), axis = flipped(v.rotors[n].a_B), turn = roll_pitch_to(axis);
  std::vector<double> pose = {r.x(), r.y(), r.z(), turn.x(), turn.y(), turn.z()};
  if (own && own->has(key(n, "pose")) && sdf_axis(*own, n).isApprox(axis, 1e-9)) {
    const std::vector<double> theirs = own->numbers(key(n, "pose"), 6);
    std::copy(theirs.begin() + 3, theirs.end(), pose.begin() + 3);  // the same axis, turned about itself
  }
  if (own && own->has("base.pose"))
    for (std::size_t i = 0; i < 3; ++i) pose[i] += own->numbers("base.pose", 6)[i];
  out.push_back({key(n, "pose"), pose, "m, rad", "hub and thrust axis; forward, left, up"});
  const double Jp = value_or_zero(v, "Jp"), m = v.value("m");
  // Without a Jp of the vehicle a user's links keep theirs.
  if (!own || Jp > 1.0000001 * kLeastMomentum * v.value("Jzz"))
    out.push_back({key(n, "izz"), {Jp * slowdown_of(own)}, "kg m^2", "Jp times the slowdown"});
  if (own) return;
  out.push_back({key(n, "mass"), {kRotorMass * m}, "kg", "a small share of m"});
  for (const char* moment : {"ixx", "iyy"})
    out.push_back({key(n, moment), {0.5 * Jp * kSlowdown}, "kg m^2", "of a thin disk"});
}

void add_motor(const Vehicle& v, const GazeboDialect& dialect, std::size_t n, std::vector<Value>& out) {
  const MotorLags lags = motor_lags(v);
  out.push_back({key(n, "motorConstant"), {rotor_ratio(v, n) * v.value("kT")}, "N/(rad/s)^2", "kT"});
  out.push_back({key(n, "momentConstant"), {torque_per_thrust(v)}, "m", "kQ/kT"});
  out.push_back({key(n, "timeConstantUp"), {lags.up}, "s", "2 zeta_m/omega_m + dead_time"});
  out.push_back({key(n, "timeConstantDown"), {lags.down}, "s", "the same while slowing down"});
  out.push_back({key(n, "maxRotVelocity"), {full_speed(v)}, "rad/s", "Omega_0 + km"});
  out.push_back(
      {key(n, "rotorDragCoefficient"), {value_or_zero(v, "rotor_drag.kd")}, "kg/rad", "rotor_drag.kd"});
  out.push_back({key(n, "turningDirection"), {}, "", "spin", v.rotors[n].s > 0 ? "ccw" : "cw"});
  if (!dialect.relative_airspeed) return;
  const double kz = value_or_zero(v, "axial_inflow.kz");
  out.push_back({key(n, "maxRelativeAirspeed"),
                 {kz > 0 ? v.value("kT") * hover_speed(v) / kz : kNoAirspeedLimit},
                 "m/s",
                 "kT Omega_hover/axial_inflow.kz"});
}

/// The links beside the base as they will be: the user's, with what of them changes.
Fields rotor_links(const Vehicle& v, const Fields* own, const std::vector<Value>& values) {
  Fields links = own ? *own : Fields("", v.file);
  for (const Value& value : values) {
    const bool of_link =
        value.name.ends_with(".izz") || value.name.ends_with(".pose") || (!own && !value.numbers.empty());
    if (!of_link || (own && !own->has(value.name))) continue;
    Field field = own ? own->at(value.name) : Field{};
    field.numbers.resize(value.numbers.size());
    for (std::size_t i = 0; i < value.numbers.size(); ++i) field.numbers[i].value = value.numbers[i];
    links.add(value.name, std::move(field));
  }
  return links;
}

}  // namespace

Capacity gazebo_capacity(const GazeboDialect& dialect) {
  Capacity holds{.each_rotor = true,
                 .up_and_down = true,
                 .rotor_momentum = true,
                 .least_momentum = kLeastMomentum,
                 .constants = {"rotor_drag.kd"},
                 .needs = {"km", "omega_m"}};
  if (dialect.relative_airspeed) holds.constants.insert("axial_inflow.kz");
  return holds;
}

Vehicle gazebo_vehicle(const Fields& f, const GazeboDialect& dialect) {
  Vehicle v;
  v.g = kGravity;
  const std::size_t rotors = sdf_rotors(f);
  if (rotors == 0 || !f.has(key(0, "motorConstant"))) f.fail("plugin", "there is no motor plugin: no rotors");
  read_motors(f, rotors, v);
  MassProperties body = sdf_body(f, true);
  body.J = flipped(body.J), body.c_B = flipped(body.c_B);
  body.Jp = mean(f, "izz", rotors, 0.0) / mean(f, "rotorVelocitySlowdownSim", rotors, kSlowdown);
  if (!f.has(key(0, "izz"))) body.Jp = 0.0;
  set_mass_properties(v, body);
  if (dialect.relative_airspeed) {
    const double limit = mean(f, "maxRelativeAirspeed", rotors, 25.0);
    if (!(limit > 0)) f.fail(key(0, "maxRelativeAirspeed"), "has to be positive");
    if (limit < kNoAirspeedLimit) {
      v.parameters["axial_inflow.kz"] = {v.value("kT") * hover_speed(v) / limit, {}};
      assume(v, f, "maxRelativeAirspeed becomes axial_inflow.kz, which agrees at hover speed");
    }
  }
  assume(v, f,
         "the command is taken as linear from 0 to maxRotVelocity: with PX4, SIM_GZ_EC_MIN and _MAX of the "
         "airframe say "
         "it");
  if (mean(f, "rollingMomentCoefficient", rotors, 0.0) != 0.0)
    assume(v, f, "rollingMomentCoefficient acts along the velocity, which no blade does: left out");
  return v;
}

void gazebo_stand_in(Vehicle& v) {
  v.g = kGravity;
  double mean_ratio = 0.0;  // kT and kQ are those of the mean rotor
  for (std::size_t n = 0; n < v.rotors.size(); ++n)
    mean_ratio += rotor_ratio(v, n) / static_cast<double>(v.rotors.size());
  if (mean_ratio == 1.0) return;
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    const double ratio = as_stated(rotor_ratio(v, n) / mean_ratio);
    v.parameters.erase(fmt::format("rotor_mismatch.ratio@{}", n + 1));
    if (ratio != 1.0) v.parameters[fmt::format("rotor_mismatch.ratio@{}", n + 1)] = {ratio, {}};
  }
  for (const char* name : {"kT", "kQ"}) v.parameters[name].value = as_stated(v.value(name) * mean_ratio);
}

std::vector<Value> gazebo_values(const Vehicle& v, const Fields* own, const GazeboDialect& dialect) {
  std::vector<Value> out;
  std::vector<Vector3d> hubs;
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    hubs.push_back(flipped(v.rotors[n].r_B));
    add_link(v, own, n, out);
    if (!own || own->has(key(n, "motorConstant")))
      add_motor(v, dialect, n, out);  // else it is the base of a model
  }
  const MassProperties body = mass_properties(v);
  const Fields links = rotor_links(v, own, out);
  const MassProperties base = sdf_base(links, {.m = body.m, .J = flipped(body.J), .c_B = flipped(body.c_B)},
                                       sdf_body(links, false, hubs));
  out.push_back({"base.mass", {base.m}, "kg", "m less the rotor links"});
  const Vector3d c = base.c_B.unaryExpr([](double x) { return std::abs(x) < kRounding ? 0.0 : x; });  // m
  out.push_back({"base.inertial", {c.x(), c.y(), c.z(), 0, 0, 0}, "m, rad", "centre of gravity"});
  const Matrix3d& J = base.J;
  for (const auto& [name, x] : {std::pair("ixx", J(0, 0)),
                                {"iyy", J(1, 1)},
                                {"izz", J(2, 2)},
                                {"ixy", J(0, 1)},
                                {"ixz", J(0, 2)},
                                {"iyz", J(1, 2)}})
    out.push_back({std::string("base.") + name,
                   {std::abs(x) < kRounding * J.trace() ? 0.0 : x},
                   "kg m^2",
                   std::string("J less the rotor links, ") + name});
  return out;
}

std::vector<std::string> gazebo_remarks(const Vehicle& whole, const Vehicle& v,
                                        const GazeboDialect& dialect) {
  std::vector<std::string> out;
  if (mass_properties(whole).Jp <= mass_properties(v).Jp * 0.999999)
    out.push_back(fmt::format("Gazebo's rotor links need inertia: Jp {:.2g} kg m^2 is given to them",
                              mass_properties(v).Jp));
  if (dialect.relative_airspeed && v.has("axial_inflow.kz"))
    out.push_back(
        "the loss of thrust in a climb goes with thrust there, not with rotor speed: it agrees at hover");
  return out;
}

}  // namespace ident
