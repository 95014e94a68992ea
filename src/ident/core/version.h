// The version of this build.
#pragma once

namespace ident {

/// Version as in `ident --version`, like "0.1.0".
const char* version();

}  // namespace ident
