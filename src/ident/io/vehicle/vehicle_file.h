// Vehicle and parameter files: one YAML schema, read with every error placed, written so that it reads back
// exactly.
#pragma once

#include <string>

#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

/// What a vehicle is read for: to compute with (a constant of the kind `positive` has to be positive, an
/// inertia too), or to be judged, where any finite value passes.
enum class VehicleUse { computing, judging };

/// Reads a vehicle or parameter file, or a simulator's file, which is known by its content. Throws InputError `file:line: key: what`.
/// `mass` becomes parameter `m`, `gravity` (or `parameters.g`) `Vehicle::g`, `slant_deg` parameter `alpha` in
/// rad. Two effects are stored under another name than in the file:
///   rotor_mismatch.rotor K, rotor_mismatch.ratio   ->  rotor_mismatch.ratio@K
///   rotor_tilt.rotor K, rotor_tilt.x, .y           ->  rotor_tilt.x@K, rotor_tilt.y@K (K absent or `all`: no
///   @)
/// and ground_effect.radius (m) as ground_effect.radius_sq (m^2), its std by the chain rule.
Vehicle read_vehicle(const std::string& path, VehicleUse use = VehicleUse::computing);

/// The file's text, correlations included. A parameter whose value or standard deviation is not finite is not
/// known: it is left out.
std::string vehicle_to_yaml(const Vehicle& vehicle);

/// Writes the file whole or not at all; throws OutputError.
void write_vehicle(const std::string& path, const Vehicle& vehicle);

/// A vehicle with what a parameter file states in addition; the parameter file wins, and what it states is
/// independent of the rest.
Vehicle with_parameters(Vehicle vehicle, const Vehicle& found);

/// The parameters that a result determines, by themselves or together (with a finite value and standard
/// deviation, known to the file format), with their correlations, laid over what a parameter file stated
/// before.
Vehicle with_result(Vehicle before, const Result& result);

}  // namespace ident
