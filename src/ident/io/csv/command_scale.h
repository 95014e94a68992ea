// What a command column holds: pulse widths, DShot throttle, percent, a fraction; told from its values.
#pragma once

#include "ident/data/table.h"

namespace ident {

/// Brings `u` (pulse width in us) and `delta` (0 to 1) of a table to what they are to hold where their header
/// states no unit or the values cannot be pulse widths. Each decision is a warning `command_scale`.
///
///     DShot 48 to 2047:  delta = (value - 47)/2000, below it nothing is commanded
///     OneShot125:        pulses of 125 to 250 us are those of 1000 to 2000 us, eight times as short
void recognise_commands(NumberTable& table);

}  // namespace ident
