// `correlations` of a vehicle or parameter file: what of its parameters is known together.
#pragma once

#include <string>
#include <vector>

#include "ident/io/file/yaml_value.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Reads `correlations: {kT: {km: -0.99}}` of a file whose parameters are read: each pair once, under the
/// names that the file has for them. Pairs of what it states no standard deviation of are left out with a
/// warning. Throws InputError for what is no parameter, and for what no covariance can be.
void read_correlations(const YamlValue& file, Vehicle& vehicle);

/// The same as text, one line for each name; those of `left_out` and of what the vehicle does not hold with a
/// standard deviation are not written.
std::string correlation_lines(const Vehicle& vehicle, const std::vector<std::string>& left_out);

}  // namespace ident
