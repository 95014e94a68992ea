// Effects outside the catalogue that have a memory or strike in bursts; only `unknown` is right for them.
#pragma once

#include <vector>

#include "physics.h"
#include "random.h"

namespace withheld {

using Aux = Eigen::Matrix<double, 12, 1>;

// Another vehicle passes overhead a few times: a push downwards that is not centred.
class Bursts {
 public:
  Bursts(const Vehicle& vehicle, double duration, Random random);
  Wrench at(double t, double buffet) const;  // per unit of Effects::downwash

 private:
  struct Burst {
    double from, length;
    Eigen::Vector3d F, M;
  };
  std::vector<Burst> bursts_;
};

// State of pendulum, sloshing mass, arms or blade phase when the vehicle hovers at `motion`.
Aux settled_aux(const Vehicle& vehicle, const Effects& effects, const Motion& motion);

struct Memory {
  Wrench wrench;  // on the airframe, beyond `others`
  Aux slope;
};

Memory remember(const Vehicle& vehicle, const Effects& effects, const Motion& motion, const Four& Omega,
                const Wrench& others, const Aux& aux);

// Thrust that passes the flexible arms, and the slope of their state, for the thrust that the rotors make.
Four transmitted_thrust(const Effects& effects, const Four& thrust, const Aux& aux, Aux* slope);

}  // namespace withheld
