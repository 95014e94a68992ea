// Fills a flight log row by row from a flying vehicle, through its sensors.
#pragma once

#include <deque>
#include <span>

#include "ident/core/random.h"
#include "ident/data/flight_log.h"
#include "ident/sim/plant.h"
#include "ident/sim/sensors.h"

namespace ident {

class Recorder {
 public:
  /// `hover_speed` scales the noise of the rotor speeds, rad/s. `random` is drawn from as rows are written.
  Recorder(const Plant& plant, const SensorNoise& noise, const LoggedSignals& signals, double hover_speed,
           Random& random);

  /// Keeps rates and attitude of this instant for the next row that has none yet (sensor delay).
  void look();
  /// What sensors show at the plant's present time.
  void row(double voltage_ratio);
  /// The command that holds from that row on.
  void command(std::span<const double> delta);

  const Vec3<double>& gyro_bias() const { return gyro_bias_; }
  /// Rates of the last row without their bias; the true ones where it has none.
  Vec3<double> rates() const;
  FlightLog take() { return std::move(log_); }

 private:
  struct Motion {
    Vec3<double> gyro;
    Vec4<double> q_WB;
  };
  double seen(int every, double truth, double std);
  void add(const Vec3<double>& truth, int every, double std, std::array<std::vector<double>, 3>& columns);
  void add_attitude(const Vec4<double>& q_WB);

  const Plant* plant_;
  SensorNoise noise_;
  LoggedSignals signals_;
  double hover_speed_;
  Random* random_;
  Vec3<double> gyro_bias_;
  std::deque<Motion> seen_motion_;
  FlightLog log_;
};

}  // namespace ident
