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

}  // namespace ident
