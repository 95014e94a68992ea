// Gusts as a coloured force and moment: what the air does to a vehicle that stands in it.
//
//   gust' = -gust/tau + sqrt(2/tau) L noise,  tau = 1.5 s       each axis, standard deviation L in m/s
//   F = 0.3 1/s m gust,   M = 0.02 m F' with an independent F'  in the body frame
//
// Assumption: the drag of small multirotors, 0.2 to 0.5 1/s a mass, whatever drag the vehicle file states;
// the gradient of a gust over the rotor disk acts as if it were off the centre by 2 cm.
#pragma once

#include "ident/core/math.h"
#include "ident/core/random.h"

namespace ident {

class Turbulence {
 public:
  /// `level`: standard deviation of the gusts, m/s. `mass` in kg.
  Turbulence(double level, double mass, Random& random);

  /// Goes on by `interval` seconds.
  void step(double interval);
  Vec3<double> F_B() const { return 0.3 * mass_ * gust_; }
  Vec3<double> M_B() const { return 0.02 * 0.3 * mass_ * gradient_; }

 private:
  double level_, mass_;
  Random* random_;
  Vec3<double> gust_, gradient_;
};

}  // namespace ident
