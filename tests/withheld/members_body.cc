// Effects of masses out of place and of sensors.
#include <cmath>

#include "members.h"

namespace withheld {

namespace {

using Eigen::Vector3d;
using Map = std::map<std::string, double>;

Map named(const std::string& effect, const std::array<const char*, 3>& names, const Vector3d& values) {
  Map result;
  for (int i = 0; i < 3; ++i) result[effect + "." + names[static_cast<std::size_t>(i)]] = values[i];
  return result;
}

constexpr std::array<const char*, 3> kXyz = {"x", "y", "z"};

void draw_payload(const Vehicle& v, Random& random, Member* m) {
  const double spare = std::pow(v.km / v.hover_speed(), 2), share = spare < 2 ? 0.15 : 0.4;
  const double x = random.uniform(-0.35, 0.35), y = random.uniform(-0.35, 0.35),
               z = random.uniform(-0.2, 0.5);
  const Vector3d at = v.arm * Vector3d(x, y, z);
  m->freedom = 4;
  m->apply = [=, mass = v.m](Effects& e, double size) {
    e.payload = share * mass * size;
    e.payload_at = at;
  };
  m->parameters = [=, mass = v.m](double size) {
    Map result = named("payload", kXyz, at);
    result["payload.m"] = share * mass * size;
    return result;
  };
}

}  // namespace

bool draw_body_member(const std::string& name, const Vehicle& v, Random& random, Member* m) {
  if (name == "cg_offset") {
    const Vector3d turn = random.direction();
    const Vector3d c = 0.05 * v.arm * Vector3d(turn.x(), turn.y(), 0.6 * turn.z());
    m->freedom = 3;
    m->apply = [=](Effects& e, double size) { e.cg = size * c; };
    m->parameters = [=](double size) { return named("cg_offset", kXyz, size * c); };
  } else if (name == "payload") {
    draw_payload(v, random, m);
  } else if (name == "products_of_inertia") {
    const Vector3d J = 0.12 * v.J.x() * random.direction();
    m->freedom = 3;
    m->apply = [=](Effects& e, double size) { e.products = size * J; };
    m->parameters = [=](double size) {
      return named("products_of_inertia", {"Jxy", "Jxz", "Jyz"}, size * J);
    };
  } else {
    return false;
  }
  return true;
}

bool draw_sensor_member(const std::string& name, const Vehicle& v, Random& random, Member* m) {
  if (name == "imu_bias") {
    const Vector3d b = 0.6 * random.direction();
    m->freedom = 3;
    m->apply = [=](Effects& e, double size) { e.acc_bias = size * b; };
    m->parameters = [=](double size) { return named("imu_bias", {"ax", "ay", "az"}, size * b); };
  } else if (name == "imu_lever_arm") {
    const Vector3d r = 0.3 * v.arm * random.direction();
    m->freedom = 3;
    m->apply = [=](Effects& e, double size) { e.imu_at = size * r; };
    m->parameters = [=](double size) { return named("imu_lever_arm", kXyz, size * r); };
  } else if (name == "imu_misalignment") {
    const Vector3d turn = 5 * M_PI / 180 * random.direction();
    m->freedom = 3;
    m->apply = [=](Effects& e, double size) { e.imu_turn = size * turn; };
    m->parameters = [=](double size) { return named("imu_misalignment", kXyz, size * turn); };
  } else if (name == "sensor_delay") {
    m->delay_margin = 0.025;
    m->apply = [](Effects& e, double size) { e.sensor_delay = 0.025 * size; };
    m->parameters = [](double size) { return Map{{"sensor_delay.tau", 0.025 * size}}; };
  } else {
    return false;
  }
  return true;
}

bool draw_outside_member(const std::string& name, const Vehicle& v, Random& random, Member* m) {
  m->form = "outside";
  if (name == "slung_load") {
    const double length = random.uniform(0.4, 1.5);
    m->apply = [=, mass = v.m](Effects& e, double size) {
      e.slung_mass = 0.3 * mass * size;
      e.slung_length = length;
    };
  } else if (name == "slosh") {
    const double rate = 2 * M_PI * random.uniform(0.8, 3);
    m->apply = [=](Effects& e, double size) {
      e.slosh_share = 0.3 * size;
      e.slosh_rate = rate;
    };
  } else if (name == "flexible_arms") {
    const double rate = 2 * M_PI * random.uniform(4, 12);
    m->apply = [=](Effects& e, double size) {
      e.arm_flex = size;
      e.arm_rate = rate;
    };
  } else if (name == "blade_imbalance") {
    const double acceleration = 4 / std::pow(v.hover_speed(), 2);  // of the vehicle, m/s^2 per speed squared
    m->apply = [=, mass = v.m](Effects& e, double size) { e.imbalance = size * mass * acceleration; };
  } else if (name == "vortex_ring") {
    m->plan.fast_descent = true;
    m->apply = [](Effects& e, double size) { e.vortex_ring = 0.35 * size; };
  } else if (name == "downwash") {
    m->apply = [](Effects& e, double size) { e.downwash = 2.5 * size; };
  } else if (name == "backlash") {
    const double width = 0.12 * v.hover_command();
    m->plan.multisine = true;
    m->apply = [=](Effects& e, double size) { e.backlash = width * size; };
  } else {
    m->form = "exact";
    return false;
  }
  return true;
}

}  // namespace withheld
