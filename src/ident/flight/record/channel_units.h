// Units of the measured channels.
#pragma once

#include <string>

namespace ident {

/// rad/s, m/s^2, rad, m/s or m.
std::string channel_unit(int channel);

}  // namespace ident
