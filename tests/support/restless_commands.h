// Commands that leave no rotor alone.
#pragma once

#include "ident/model/flight.h"

namespace ident::testing {

/// Commands of all rotors over one second, different for each.
inline FlightInputs restless_commands(std::size_t rotors) {
  FlightInputs inputs;
  for (std::size_t n = 0; n < rotors; ++n) {
    std::vector<double> t, delta;
    const double phase = 1.7 * static_cast<double>(n);
    for (int i = 0; i < 100; ++i)
      t.push_back(0.01 * i), delta.push_back(0.55 + 0.2 * std::sin(0.3 * i + phase));
    inputs.delta.push_back(HeldCommand(t, delta));
  }
  return inputs;
}

}  // namespace ident::testing
