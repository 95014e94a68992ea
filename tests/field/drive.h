// Battery, ESCs and motors: from the command to the rotor speed, first order with two time constants.
#pragma once

#include <deque>

#include "effects.h"

namespace field {

class BatteryState {
 public:
  BatteryState(const Battery& battery, double charge);  // charge 0 to 1
  void advance(double power, double dt);                // W of the rotors
  double voltage() const { return voltage_; }
  double current() const { return current_; }

 private:
  double open_circuit() const;
  Battery battery_;
  double charge_, current_ = 0, slow_drop_ = 0, voltage_;
};

// Which part of the true drive a motor has: the truth has all, a shadow lacks one.
struct DriveTraits {
  bool sags = true, asymmetric = true, late = true, dead_zone = true;
};

class Drive {
 public:
  Drive(const Vehicle& v, const Effects& e, DriveTraits traits, double dt, const PerRotor& Omega);
  // Commands between 0 and 1; voltage in V.
  void advance(const PerRotor& command, double voltage);
  const PerRotor& Omega() const { return Omega_; }
  const PerRotor& dOmega() const { return dOmega_; }  // of the last step

 private:
  const Vehicle& v_;
  const Effects& e_;
  DriveTraits traits_;
  double dt_;
  PerRotor Omega_, dOmega_, taken_;
  std::deque<PerRotor> on_the_way_;
};

double commanded_speed(const Vehicle& v, double exponent, double command, double voltage);

}  // namespace field
