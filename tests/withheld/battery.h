// The battery: open-circuit voltage over charge, internal resistance, and one slow polarisation.
#pragma once

#include "vehicle.h"

namespace withheld {

struct Charge {
  double left = 1;          // share of the pack
  double polarisation = 0;  // V
};

class Battery {
 public:
  explicit Battery(const Vehicle& vehicle);

  double current(const Four& Omega) const;                     // A
  double voltage(const Charge& charge, double current) const;  // V at the terminals
  Charge slope(const Charge& charge, double current) const;    // per second
  double reference() const { return reference_; }              // V at which the speed per command is km
  void set_reference(double volts) { reference_ = volts; }
  Charge settled(double left) const;  // after long hover

 private:
  double cells_, power_per_cube_, hover_current_, resistance_, capacity_, reference_;
};

}  // namespace withheld
