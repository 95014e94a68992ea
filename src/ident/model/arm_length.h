// How far the rotors' hubs are from the centre of a vehicle.
#pragma once

#include <optional>

#include "ident/model/vehicle.h"

namespace ident {

/// Centre to hub, m: the parameter `l`, else the file's `arm`, else the mean over the rotors in the plane of
/// x and y; none without rotors beside the centre.
std::optional<Known> arm_length(const Vehicle& vehicle);

}  // namespace ident
