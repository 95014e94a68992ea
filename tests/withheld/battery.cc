// The battery of a lithium polymer pack whose hover current follows from its endurance.
#include "battery.h"

#include <cmath>

namespace withheld {

namespace {
constexpr double kNominal = 3.7;         // V a cell
constexpr double kPolarisationTime = 8;  // s

double open_circuit(double left) { return 3.45 + 0.55 * left + 0.18 * std::pow(std::max(left, 0.0), 6); }
}  // namespace

Battery::Battery(const Vehicle& v) : cells_(v.cells) {
  const double efficiency = 0.75, hover = v.hover_speed();
  power_per_cube_ = v.kQ / efficiency;
  hover_current_ = kRotors * power_per_cube_ * std::pow(hover, 3) / (kNominal * cells_);
  resistance_ = 0.035 * kNominal * cells_ / hover_current_;  // a drop of 3.5 % in hover at once
  capacity_ = hover_current_ * v.endurance;
  reference_ = open_circuit(1) * cells_;
}

double Battery::current(const Four& Omega) const {
  return power_per_cube_ * Omega.array().cube().sum() / (kNominal * cells_);
}

double Battery::voltage(const Charge& charge, double current) const {
  return cells_ * open_circuit(charge.left) - resistance_ * current - charge.polarisation;
}

Charge Battery::slope(const Charge& charge, double current) const {
  return {-current / capacity_, (0.6 * resistance_ * current - charge.polarisation) / kPolarisationTime};
}

Charge Battery::settled(double left) const { return {left, 0.6 * resistance_ * hover_current_}; }

}  // namespace withheld
