// What the instruments would show along a flown trajectory, as a function of vehicle and effects.
#pragma once

#include <functional>

#include "simulate.h"

namespace withheld {

// Columns: specific force by accelerometer (3) and by velocity (3), angular acceleration by gyro (3) and by
// attitude (3), rotor speeds (4).
constexpr int kChannels = 16;
using Channels = Eigen::Matrix<double, Eigen::Dynamic, kChannels>;

// The trajectory (motion, air, commands, voltage) is that of the flight; only vehicle and effects vary.
class Prediction {
 public:
  Prediction(const Flight& flight, const Instruments& instruments);

  Channels operator()(const Vehicle& vehicle, const Effects& effects);
  Channels recorded() const;             // what the flight itself did, outside effects included
  double rate() const { return rate_; }  // Hz

 private:
  const std::vector<Spin>& spin(const Vehicle& vehicle, const Effects& effects);

  const Flight& flight_;
  std::size_t every_;
  Eigen::Index rows_;
  double rate_;
  std::vector<double> voltage_ratio_;
  std::vector<std::pair<std::vector<double>, std::vector<Spin>>> kept_;  // by the parameters of the drive
};

// A direction in which a diagnosis may explain: a parameter of an effect, per unit of `apply`'s size.
struct Direction {
  std::string effect;
  std::function<void(Effects&, double)> apply;
  double step;
  std::function<void(Effects&)> nuisance = nullptr;  // on while the derivative is taken
};
std::vector<Direction> catalogue_directions(const Vehicle& vehicle);

}  // namespace withheld
