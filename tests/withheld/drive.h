// Motors with their speed controllers: from the logged commands to rotor speeds, with delay and sag.
#pragma once

#include <vector>

#include "effects.h"
#include "vehicle.h"

namespace withheld {

// Commands as logged: each holds from its time to the next.
class Commands {
 public:
  void push(double t, const Four& delta);
  // Mean over a step that ends at or before the time of the next command.
  Four mean(double from, double to) const;
  std::size_t size() const { return t_.size(); }
  double time(std::size_t i) const { return t_[i]; }
  const Four& delta(std::size_t i) const { return delta_[i]; }

 private:
  std::vector<double> t_;
  std::vector<Four> delta_;
  mutable std::size_t cursor_ = 0;
};

// Acceleration of the rotors towards `target` = km delta at the present voltage.
Four rotor_acceleration(const Vehicle& vehicle, const Effects& effects, const Four& target, const Four& Omega,
                        const Four& dOmega);

double speed_per_command(const Vehicle& vehicle, const Effects& effects, double voltage_ratio);

// Play between two stops: the output moves only once the input has crossed the width.
Four follow_with_play(const Four& output, const Four& input, double width);

struct Spin {
  Four Omega, dOmega;
};

// The speeds at the commands' times, from the first one's state on; `voltage_ratio` at the same times.
std::vector<Spin> predict_spin(const Vehicle& vehicle, const Effects& effects, const Commands& commands,
                               const std::vector<double>& voltage_ratio, const Spin& start);

constexpr double kStep = 5e-4;  // s, longest integration step

}  // namespace withheld
