// Reads vehicle and parameter files.
#pragma once

#include "ident/io/vehicle/vehicle_file.h"

namespace ident {

class YamlValue;

/// The level that a value of `air:` names.
AirLevel read_air(const YamlValue& value);

/// Reads a vehicle or parameter file. Throws InputError `file:line: key: what`.
/// `mass` becomes parameter `m`, `gravity` (or `parameters.g`) `Vehicle::g`, `slant_deg` parameter `alpha` in
/// rad. Two effects are stored under another name than in the file:
///   rotor_mismatch.rotor K, rotor_mismatch.ratio   ->  rotor_mismatch.ratio@K
///   rotor_tilt.rotor K, rotor_tilt.x, .y           ->  rotor_tilt.x@K, rotor_tilt.y@K (K absent or `all`: no
///   @)
/// and ground_effect.radius (m) as ground_effect.radius_sq (m^2), its std by the chain rule.
Vehicle read_vehicle(const std::string& path, VehicleUse use = VehicleUse::computing);

/// Same as `read_vehicle`, from a mapping.
Vehicle vehicle_from(const YamlValue& mapping, VehicleUse use = VehicleUse::computing);

}  // namespace ident
