// An estimated constant with its deviation, interval and source.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "ident/core/math.h"

namespace ident {

/// An estimate in SI units. `std` is corrected for the colour of the residuals, `naive_std` is not.
struct Parameter {
  std::string name;  ///< as in the file formats: kT, Jxx, rotor_drag.kd
  double value = kNaN;
  double std = kNaN;
  std::array<double, 2> ci95{kNaN, kNaN};
  std::string unit;
  bool identifiable = true;
  std::string source;  ///< command that found it: thrust, motor, flightlog, prior
  std::optional<double> naive_std;
  std::optional<double> prior_value, prior_std;
  std::optional<double> pull;         ///< (value - prior) over its standard deviation
  std::optional<double> from_flight;  ///< share of the information that came from the data, 0 to 1
  std::string note;                   ///< why not identifiable, in words
  /// Not identifiable by itself, and yet of one model with what is: known together, they are stored together.
  bool joint = false;
  bool known_together = false;  ///< with others, before: the pull is that against what was known of them all

  /// Nothing to be used, whatever its deviation says.
  void doubt(std::string why) {
    if (identifiable) note = std::move(why);
    identifiable = joint = false;
  }
};

}  // namespace ident
