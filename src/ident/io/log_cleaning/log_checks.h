// Checks of a flight log that was read: what its numbers say about units, frames and rates.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"

namespace ident {

/// Components of one sensor.
using Components = std::span<std::vector<double>>;

/// Removes a sensor whose components never change (warning `constant_signal`) or are all empty; of three, one
/// that never changes while another does counts as not sampled.
void drop_constant(FlightLog& log, Components sensor, const std::string& name);

/// Makes NaN what a log repeats between two samples of a slower sensor (warning `held_samples`).
void drop_held(FlightLog& log, Components sensor, const std::string& name);

/// Makes NaN where a sensor that else changes with every row stands still for 0.15 s or more, and 20 rows,
/// while another one does not (warning `frozen_signal`).
void drop_frozen(FlightLog& log, Components sensor, const std::string& name);

/// A sensor under the name by which people know it.
struct NamedSensor {
  std::string name;
  std::span<const std::vector<double>> components;
};

/// Tells the rates of the sensors in one notice, those of equal rate together.
void tell_rates(FlightLog& log, const std::vector<NamedSensor>& sensors);

/// Throws InputError where time is in another unit than s, or than the one the user said (`unit_stated`);
/// warns of gaps.
void check_time(FlightLog& log, long header_line, bool unit_stated);

/// Throws InputError where specific force is in g, or where its sign belongs to another body frame; warns
/// where gravity is missing from it.
void check_specific_force(FlightLog& log, long header_line, double gravity);

/// A voltage of zero and less is none: not sampled. Throws InputError where the battery shows a voltage in
/// another unit than that at which km holds.
void check_voltage(FlightLog& log, long header_line, double voltage_of_km);

}  // namespace ident
