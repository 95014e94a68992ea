// Effects of the air: drag, lift, inflow, flapping, ground, wind; sizes by mass and hover speed.
#include <cmath>

#include "members.h"

namespace withheld {

namespace {

// kg/rad at each hub for a drag or damping of `rate` 1/s per mass.
double per_hub(const Vehicle& v, double rate) { return v.m * rate / (kRotors * v.hover_speed()); }

void draw_wind(const Vehicle& v, Random& random, Member* m) {
  const double kd = per_hub(v, random.uniform(0.2, 0.45));
  const double speed = v.m < 0.1 ? 4 : v.m < 0.5 ? 7 : 9, heading = random.uniform(0, 2 * M_PI);
  const Eigen::Vector3d w =
      speed * Eigen::Vector3d(std::cos(heading), std::sin(heading), random.normal(0, 0.05));
  m->freedom = 3;
  m->apply = [w](Effects& e, double size) { e.wind = size * w; };
  m->parameters = [w](double size) {
    return std::map<std::string, double>{
        {"wind.north", size * w.x()}, {"wind.east", size * w.y()}, {"wind.down", size * w.z()}};
  };
  m->accompanying = {"rotor_drag"};
  m->accompany = [kd](Effects& e) { e.drag += kd; };
}

void draw_flapping(const Vehicle& v, Random& random, Member* m) {
  // A disc that tilts by 3 degrees at 5 m/s; hinge offset or stiffness turns a part of it into hub moment.
  const double tilt = 3 * M_PI / 180 / 5;
  const double moment = v.kT * v.hover_speed() * tilt * v.radius * random.uniform(0.2, 0.7);
  const bool tilts_thrust = random.chance(0.5);
  const double back = tilts_thrust ? v.kT * v.hover_speed() * tilt : 0;
  m->form = tilts_thrust ? "near" : "exact";
  m->apply = [=](Effects& e, double size) {
    e.flap_moment = size * moment;
    e.flap_tilt = size * back;
  };
  m->parameters = [=](double size) {
    return std::map<std::string, double>{{"blade_flapping.kf", size * moment}};
  };
  if (tilts_thrust) m->accompanying = {"rotor_drag"};  // the force has the very form of rotor drag
}

}  // namespace

bool draw_air_member(const std::string& name, const Vehicle& v, Random& random, Member* m) {
  using Map = std::map<std::string, double>;
  if (name == "rotor_drag") {
    const double kd = per_hub(v, 0.6);
    const bool blades = random.chance(0.5);
    m->form = blades ? "near" : "exact";
    m->apply = [=](Effects& e, double size) {
      e.drag += size * kd;
      e.drag_follows_inflow = blades;
    };
    m->parameters = [=](double size) { return Map{{"rotor_drag.kd", size * kd}}; };
  } else if (name == "parasitic_drag") {
    const double C = 0.015 * std::pow(v.arm / 0.17, 2),
                 across = random.chance(0.5) ? random.uniform(1.3, 2) : 1;
    m->form = across == 1 ? "exact" : "near";
    m->apply = [=](Effects& e, double size) {
      e.body_drag = size * C;
      e.body_drag_z = across;
    };
    m->parameters = [=](double size) { return Map{{"parasitic_drag.C", size * C}}; };
  } else if (name == "translational_lift") {
    // T0 (1 - y) with y = 1 - (v/v_h)^2/4 at low speed, T0 = 2 rho A v_h^2: kh = gain rho A/2.
    const double half = 0.5 * v.air_density * M_PI * v.radius * v.radius,
                 gain = 0.004 / half * std::pow(v.radius / 0.1, 2);
    m->form = "other";
    m->apply = [=](Effects& e, double size) { e.lift_gain = size * gain; };
    m->parameters = [=](double size) { return Map{{"translational_lift.kh", size * gain * half}}; };
  } else if (name == "axial_inflow") {
    const double k = 2 * per_hub(v, 1.2);  // half of the climb speed is made up for by less induced speed
    m->form = "near";
    m->apply = [=](Effects& e, double size) { e.inflow = size * k; };
    m->parameters = [=](double size) { return Map{{"axial_inflow.kz", 0.5 * size * k}}; };
  } else if (name == "blade_flapping") {
    draw_flapping(v, random, m);
  } else if (name == "ground_effect") {
    m->form = "other";
    m->plan.near_ground = true;
    m->apply = [](Effects& e, double size) { e.ground = 2 * size; };
    m->parameters = [R = v.radius](double size) {
      return Map{{"ground_effect.radius", R * std::sqrt(2 * size)}};
    };
  } else if (name == "wind") {
    draw_wind(v, random, m);
  } else {
    return false;
  }
  return true;
}

}  // namespace withheld
