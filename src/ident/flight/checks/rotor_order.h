// Do the rotors as mounted explain how the vehicle turns? Every other order of the rotors, and every reversed
// axis, is tried against the order as stated.
#pragma once

#include "ident/flight/checks/log_self_test.h"

namespace ident {

/// Tries every order; what it makes of them waits until it is known of the rates.
RotorTest test_rotors(const FlightRecord& record, const Vehicle& vehicle, std::span<const double> p);

}  // namespace ident
