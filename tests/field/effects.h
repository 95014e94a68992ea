// What acts on a vehicle beyond its nominal model: in the catalogue's words, or in no catalogue at all.
#pragma once

#include <string>
#include <vector>

#include "vehicle.h"

namespace field {

struct Burst {                  // another vehicle passes above
  double from = 0, length = 0;  // s
  double speed = 0;             // m/s, downward
};

struct Effects {
  // Air. Zero is the nominal model.
  double blade_slope = 0;  // kg/rad, B in T = kT Omega^2 + B Omega (v_static - v_induced - v_axial)
  bool axial = false, translational = false;  // which part of that flow the rotor feels
  double kd = 0;                              // kg/rad, drag of the blades across the thrust axis
  double kf = 0;                              // N s^2/rad, hub moment of flapping blades
  double tilt = 0;                            // rad per advance ratio, the thrust tilts back
  Vector3d C = Vector3d::Zero();              // N s^2/m^2, drag of the body along its axes
  double ground_radius = 0;                   // m
  Vector3d wind_W = Vector3d::Zero();         // m/s, mean
  // Motors and body.
  double sag_exponent = 0;  // rotor speed goes with (V/V_reference) to this power
  int weak_rotor = -1;
  double weak_ratio = 1;
  Vector3d c_B = Vector3d::Zero();       // m, centre of gravity from the origin
  Vector3d products = Vector3d::Zero();  // Jxy, Jxz, Jyz
  bool rotor_momentum = true;            // Jp acts; an effect where the file states none
  // Sensors.
  Vector3d imu_bias = Vector3d::Zero();  // m/s^2
  Vector3d imu_r_B = Vector3d::Zero();   // m
  Vector3d imu_turn = Vector3d::Zero();  // rad
  // In no model.
  double arm_hz = 0, arm_damping = 0;    // bending arms
  double slosh_share = 0, slosh_hz = 0;  // of the mass, in a tank
  double propwash = 0;                   // thrust fluctuation in descent, relative
  bool bursts = false;                   // downwash
  double vibration = 0;                  // m/s^2 of the sensors' tone
  double dead_zone = 0;                  // command change that an ESC ignores
  std::vector<std::string> extra;        // names of what was drawn beside the usual
};

// Fields that are set back to nominal take the effect out; unknown names throw.
Effects without(Effects e, const std::string& cause);

// `only`: "" draws by chance; "plain" nothing; else the named extras, comma separated.
Effects draw_effects(Random& random, const Vehicle& v, bool plain, const std::string& only);

// Names in the catalogue, and names outside, of which `e` holds any.
std::vector<std::string> causes_present(const Effects& e, const Vehicle& v);
bool outside_catalogue(const std::string& cause);

}  // namespace field
