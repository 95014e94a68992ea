// The constants of the full flight model for exports that are programs: effects folded, the rest by name.
#pragma once

#include <string>
#include <vector>

#include "ident/io/simulators/capacity.h"
#include "ident/io/simulators/value.h"
#include "ident/model/vehicle.h"

namespace ident {

/// All that a program of the full model holds: everything but sensors, wind and the battery's voltage.
Capacity full_model_capacity();

/// Scalars under names that are identifiers ("rotor_drag_kd"), then "rotor_r", "rotor_a", "rotor_s",
/// "rotor_ratio".
std::vector<Value> full_model_values(const Vehicle& vehicle);

/// Whether an entry is one number a rotor or more.
bool is_of_rotors(const Value& value);

std::vector<std::string> full_model_remarks(const Vehicle& whole);

}  // namespace ident
