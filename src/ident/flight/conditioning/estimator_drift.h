// Whether attitude, velocity and position of a log come from an estimator, which is off slowly.
#pragma once

#include "ident/flight/record/flight_record.h"

namespace ident {

/// Slow errors, and whether it is an estimator that shows attitude, velocity and position.
struct FoundSlowErrors {
  SlowErrors errors{};
  bool of_estimator = false;
};

/// Slow errors of what is shown, to start from: where attitude strays from integrated rates, velocity from
/// integrated specific force, or position from integrated velocity by more than the white noise of both makes
/// it; all zero where that is not so, or cannot be told. Without a model of the vehicle: what mounting,
/// scale, bias or delay of a sensor does is taken out by regression. For a record with its noise and start.
FoundSlowErrors slow_errors(const FlightRecord& record);

/// Puts them into the record, with states for them, and with as much white noise as hides what an estimator
/// integrates, and says so (slow_errors).
void add_slow_errors(FlightRecord& record);

/// Whether a channel has such errors: what is left of it is no white noise, and tells nothing of the vehicle.
bool is_slowly_off(const FlightRecord& record, int channel);

}  // namespace ident
