// The identified vehicle as an autopilot flies it: the plant of the simulator, standing on the ground at
// first, with what the autopilot's sensors read.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "ident/fly/ground_contact.h"

namespace ident {

/// What sensors without noise read, with the IMU's effects and the delay of rates and attitude.
struct Readings {
  double t = 0.0;                 ///< s since the vehicle was put on the ground
  Vec3<double> gyro_B, f_B;       ///< rates, rad/s; specific force, m/s^2; body FRD
  Vec4<double> q_WB;              ///< FRD to NED
  Vec3<double> v_W, x_W;          ///< m/s and m, NED
  Vec3<double> start_W;           ///< where the vehicle stood at first, m, NED
  std::vector<double> Omega;      ///< rotor speeds, rad/s
  std::optional<double> voltage;  ///< of the battery, V
};

class ServedVehicle {
 public:
  /// Throws UsageError where the vehicle lacks what flight needs. `legs`: as in GroundContact, m.
  explicit ServedVehicle(const Vehicle& vehicle, double legs = 0.0);

  const Vehicle& vehicle() const { return plant_.vehicle(); }
  /// On the ground again at t = 0, level, heading north, with motors that stand.
  void restart();
  /// Goes on by some seconds under commands, 0 to 1, that hold from now. Throws DataError where the motion
  /// leaves the numbers.
  void step(std::span<const double> delta, double seconds);

  const Readings& readings() const { return readings_; }
  const FlightState<double>& state() const { return plant_.state(); }
  /// The commands as they reach the motors: within 0 to 1, and not below that at which a rotor stands.
  std::vector<double> felt(std::span<const double> delta) const;

 private:
  struct Turning {
    double t;
    Vec3<double> gyro_B;
    Vec4<double> q_WB;
  };
  void touch();
  void look();
  Turning delayed() const;
  void read();
  void forget();

  Plant plant_;
  GroundContact ground_;
  double least_delta_;
  Readings readings_;
  std::deque<Turning> turning_;                ///< over the delay of the sensors
  std::vector<double> command_times_;          ///< of what the motors may still feel
  std::vector<std::vector<double>> commands_;  ///< [rotor][time]
};

}  // namespace ident
