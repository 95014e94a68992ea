// Effects of battery, motors and rotors.
#include <cmath>

#include "members.h"

namespace withheld {

namespace {

using Map = std::map<std::string, double>;

void draw_tilt(Random& random, Member* m) {
  const int rotor = random.chance(0.25) ? 0 : random.integer(1, kRotors);  // 0: all of them
  const double angle = random.uniform(0, 2 * M_PI), most = (rotor == 0 ? 3.0 : 5.0) * M_PI / 180;
  const Eigen::Vector2d turn = most * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  m->freedom = 2;
  m->apply = [=](Effects& e, double size) {
    for (int i = 0; i < kRotors; ++i) {
      if (rotor == 0 || rotor == i + 1) e.tilt.col(i) = size * turn;
    }
  };
  m->parameters = [=](double size) {
    Map result{{"rotor_tilt.x", size * turn.x()}, {"rotor_tilt.y", size * turn.y()}};
    if (rotor > 0) result["rotor_tilt.rotor"] = rotor;
    return result;
  };
}

}  // namespace

bool draw_drive_member(const std::string& name, const Vehicle& v, Random& random, Member* m) {
  if (name == "battery_sag") {
    m->form = "near";
    m->apply = [](Effects& e, double size) { e.sag = size; };
    m->parameters = [](double size) { return Map{{"battery_sag.n", size}}; };
  } else if (name == "motor_delay") {
    m->delay_margin = 0.03;
    m->apply = [](Effects& e, double size) { e.command_delay = 0.03 * size; };
    m->parameters = [](double size) { return Map{{"motor_delay.tau", 0.03 * size}}; };
  } else if (name == "motor_asymmetry") {
    m->form = "near";
    m->apply = [](Effects& e, double size) { e.slow_spin_down = 0.45 * size; };
    m->parameters = [](double size) { return Map{{"motor_asymmetry.ratio", 1 - 0.45 * size}}; };
  } else if (name == "thrust_curve") {
    const double most = 0.3 * random.sign();
    m->form = "near";
    m->apply = [=](Effects& e, double size) { e.thrust_power = most * size; };
    m->parameters = [=](double size) { return Map{{"thrust_curve.c", most * size}}; };
  } else if (name == "rotor_mismatch") {
    const int rotor = random.integer(1, kRotors);
    const double spare = std::pow(v.km / v.hover_speed(), 2), most = spare < 2 ? 0.15 : 0.25;
    m->apply = [=](Effects& e, double size) { e.weakness[rotor - 1] = most * size; };
    m->parameters = [=](double size) {
      return Map{{"rotor_mismatch.rotor", rotor}, {"rotor_mismatch.ratio", 1 - most * size}};
    };
  } else if (name == "rotor_tilt") {
    draw_tilt(random, m);
  } else if (name == "gyroscopic") {
    const double Jp = 0.012 * v.J.x();
    m->apply = [=](Effects& e, double size) { e.Jp = Jp * size; };
    m->parameters = [=](double size) { return Map{{"gyroscopic.Jp", Jp * size}}; };
  } else {
    return false;
  }
  return true;
}

}  // namespace withheld
