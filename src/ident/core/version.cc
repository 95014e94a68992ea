// The version of this build, as the build file states it.
#include "ident/core/version.h"

namespace ident {

const char* version() { return IDENT_VERSION; }

}  // namespace ident
