// Finds links, joints and motor plugins in an SDF model, its own and those of an included one.
#pragma once

#include "ident/io/simulators/sdf/sdf_model.h"

namespace ident {

/// Fields of the links: "base.mass", "base.ixx".., "base.inertial" (pose), "rotorN.pose", "rotorN.mass",
/// "rotorN.izz".., "linkN..." for the rest; and of the plugins: "rotorN.motorConstant",
/// "rotorN.turningDirection"... in the order of the motors' numbers. `plugin` is a part of the plugins' file
/// names. Links of an included model that lies beside the file's folder count, but cannot be patched from
/// here. Throws InputError.
Fields sdf_fields(const std::string& text, const std::string& file, std::string_view plugin);

}  // namespace ident
