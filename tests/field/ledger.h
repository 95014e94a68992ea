// What each cause does along a flight, and which share of the gap it closes by itself.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "drive.h"
#include "sensors.h"
#include "stated.h"

namespace field {

// A true vehicle less one cause, at one instant.
struct Signature {
  Vector3d f_W = Vector3d::Zero();    // m/s^2
  Vector3d dw_B = Vector3d::Zero();   // rad/s^2
  PerRotor dOmega;                    // rad/s, speed of the rotors
  Vector3d accel = Vector3d::Zero();  // m/s^2, reading beside f
  Vector3d gyro = Vector3d::Zero();   // rad/s, reading beside the true rate
  Vector3d f_B = Vector3d::Zero();    // m/s^2, as f_W
};

struct Share {
  double all = 0, forces = 0, moments = 0;  // of the squared error over sensor noise
  double velocity_rms = 0;                  // m/s after 0.5 s
  double rate_rms = 0;                      // rad/s after 0.1 s
};

class Ledger {
 public:
  explicit Ledger(double hz) : hz_(hz) {}
  void add(const std::string& cause, Signature s) { series_[cause].push_back(std::move(s)); }
  // Share that each cause closes of what all causes together do: 1 - |all - cause|^2/|all|^2, in windows that
  // start every 0.1 s. Forces: velocity after 0.5 s. Moments: rates after 0.1 s. All: these, specific force
  // and speeds. The mean of a specific force along the body's z is left to kT, unless the cause is a constant
  // itself.
  std::map<std::string, Share> shares(const Instruments& in, const std::vector<std::string>& causes) const;

 private:
  double hz_;
  std::map<std::string, std::vector<Signature>> series_;
};

// A motor that lacks one thing, or has one constant as stated, beside the true one.
struct Shadow {
  std::string cause;
  DriveTraits traits;
  Vehicle vehicle;
};
std::vector<Shadow> draw_up_shadows(const Vehicle& v, const Effects& e, const Stated& stated);

// Everything that acts at this instant, cause by cause.
struct Instant {
  const Vehicle& v;
  const Effects& e;
  const Stated& stated;
  const Motion& motion;
  const RotorState& rotors;
  const AirSample& air;
  const Acceleration& now;    // with all causes
  const Acceleration& rigid;  // without a sloshing tank
  double burst = 0;           // m/s, downward air of another vehicle
  double gyro_delay = 0;      // s
};
void record(Ledger& ledger, const Instant& instant, const std::map<std::string, PerRotor>& shadow_speeds);

}  // namespace field
