// What a diagnosis owes to commands that were logged more seldom than they were flown.
#pragma once

#include "ident/gap/verdict/verdict.h"

namespace ident {

/// The verdict on logs whose commands, `interval` seconds apart, tell less than what the motors did: what is
/// not "none", nor there whatever else is, is unknown, and that is why.
Judged with_seldom_commands(Judged verdict, double interval);

}  // namespace ident
