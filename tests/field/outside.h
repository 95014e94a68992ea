// What no model of the catalogue has and what keeps a memory: bending arms, a sloshing tank, propwash.
#pragma once

#include "body.h"

namespace field {

// Each arm is a spring and damper between rotor and body: the body feels the thrust through a resonance.
//     x'' + 2 d w x' + w^2 x = w^2 T ,   force on the body: x + 2 d x'/w
class BendingArms {
 public:
  BendingArms(const Effects& e, int rotors, double dt);
  // Force on the body less the thrust, N.
  PerRotor advance(const std::vector<RotorLoad>& loads);

 private:
  double w_, damping_, dt_;
  PerRotor x_, slope_;
  bool started_ = false;
};

// A mass that swings across the body's vertical axis in a tank above the centre of gravity.
//     x'' + 2 d w x' + w^2 x = -(f + dw x h) ,   force on the body: share m (w^2 x + 2 d w x')
class SloshingTank {
 public:
  SloshingTank(const Vehicle& v, const Effects& e, double dt);
  Acceleration advance(const Acceleration& rigid);  // of the body with the swinging mass

 private:
  double share_, w_, dt_, height_;
  Vector3d m_over_J_;
  Vector3d x_ = Vector3d::Zero(), slope_ = Vector3d::Zero();
};

// Thrust fluctuates at 4 to 15 Hz while the vehicle sinks into its own wake.
class Propwash {
 public:
  Propwash(const Vehicle& v, const Effects& e, Random random, double dt);
  PerRotor advance(const Motion& motion, const Vector3d& wind_W);

 private:
  double amplitude_, inflow_, dt_, w_;
  Random random_;
  PerRotor x_, slope_;
};

}  // namespace field
