// What a simulation leaves over of a log: residuals over time, their distribution, colour and spectrum.
#pragma once

#include "ident/result/result.h"

namespace ident {

/// From the pictures of a verification (one for each channel, with a measured and a simulated series) the
/// residuals of body rates and vertical specific force. Empty where none of these channels is there.
Section simulation_residuals(const Section& verification);

}  // namespace ident
