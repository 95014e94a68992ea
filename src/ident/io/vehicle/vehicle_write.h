// Writes vehicle and parameter files, every number in the shortest text that reads back as the same double.
#pragma once

#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_yaml.h"

namespace ident {

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
/// before. What a result does not determine stays as it was stated: each value that goes with it is stored as
/// its mean beside that.
Vehicle with_result(Vehicle before, const Result& result);

/// A word as a double-quoted YAML scalar.
std::string quoted(const std::string& text);

}  // namespace ident
