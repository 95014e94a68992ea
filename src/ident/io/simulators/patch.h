// Replaces numbers in a user's own file by their places: comments and layout stay byte for byte.
#pragma once

#include "ident/io/simulators/simulators.h"

namespace ident {

/// The user's own file with the vehicle's values: nothing else changes. Throws InputError for a file of
/// another format. Entries that are the same for `unchanged` are left as they stand.
SimulatorExport patch_simulator(const SimulatorFormat& format, const std::string& text,
                                const std::string& file, const Vehicle& vehicle,
                                const Vehicle* unchanged = nullptr);

}  // namespace ident
