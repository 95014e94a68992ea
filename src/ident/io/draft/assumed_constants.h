// Constants of a vehicle that nobody measured, guessed from its size, each as wide as the guess is.
#pragma once

#include <string>

namespace ident {

/// Lines of `parameters:` in a vehicle file, each marked ASSUMED.
std::string assumed_constants(double mass, double arm, int rotors);

}  // namespace ident
