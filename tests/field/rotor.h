// Loads of one rotor in its local flow: momentum theory with a linear blade law, blade drag and flapping.
#pragma once

#include "effects.h"

namespace field {

struct RotorLoad {
  double T = 0;                          // N, along the thrust axis (0, 0, -1)
  Vector3d across_B = Vector3d::Zero();  // N, in the plane of the rotor
  Vector3d hub_B = Vector3d::Zero();     // N m, moment of bending blades
  double Q = 0;                          // N m, drag torque
};

struct RotorFlow {
  Vector3d v_B = Vector3d::Zero();  // m/s, hub against the air
  double height = 100;              // m above ground
  double fluctuation = 0;           // relative change of thrust
};

//     T = kT W^2 + B W (nu - v_i - v_c) ,   nu = W sqrt(kT/(2 rho A))        (1)
//     T = 2 rho A v_i sqrt(v_perp^2 + (v_i + v_c)^2)     [Glauert]             (2)
// W rotor speed, v_c flow down through the disc by climb, v_i induced. At rest both give kT W^2.
double rotor_thrust(const Vehicle& v, const Effects& e, double Omega, double v_perp, double v_climb);

// kz of the catalogue's thrust -kz Omega v: slope of (1) and (2) at hover.
double effective_kz(const Vehicle& v, const Effects& e);

RotorLoad rotor_load(const Vehicle& v, const Effects& e, int index, double Omega, const RotorFlow& flow);

}  // namespace field
