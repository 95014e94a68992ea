// What was read and how noisy it is, as a section of a report.
#pragma once

#include <span>

#include "ident/data/flight_log.h"
#include "ident/flight/conditioning/rotor_vibration.h"
#include "ident/flight/record/flight_record.h"
#include "ident/result/result.h"

namespace ident {

/// Data health: rates, arcs, noise levels, units and frames as they were decided.
Section data_health(const FlightRecord& record, std::span<const FlightLog> logs, const NoiseModel& noise,
                    const Vibration& vibration);

}  // namespace ident
