// What the vehicle file states: constants that are off, with the deviations that an honest bench would give.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "effects.h"

namespace field {

struct Constant {
  double truth = 0, value = 0, std = 0;
  bool overconfident = false;  // the error is many stated deviations
};

struct Stated {
  std::map<std::string, Constant> constants;  // m kT kQ km lag Jxx Jyy Jzz; Omega_0 Jp dead_time where stated
  bool second_order = false;                  // motors stated with zeta_m = 1, else with zeta_m = 50
  bool drag = false, sag = false, reference_voltage = false;
  std::string air = "light";
  bool states(const std::string& name) const { return constants.contains(name); }
};

Stated draw_statement(Random& random, const Vehicle& v, const Effects& e, bool plain, const std::string& air);

// The vehicle that has one constant as stated.
Vehicle with_stated(Vehicle v, const std::string& name, double value);

// Drag of the blades as the catalogue's kd, with the part of a thrust that tilts back.
double effective_kd(const Vehicle& v, const Effects& e);

void write_vehicle_file(const std::string& path, const std::string& name, const Vehicle& v,
                        const Stated& stated, bool pulses);

}  // namespace field
