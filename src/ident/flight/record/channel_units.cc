// Units by sensor.
#include "ident/flight/record/channel_units.h"

#include "ident/flight/kernel/kernel.h"

namespace ident {

std::string channel_unit(int channel) {
  if (channel < kForce) return "rad/s";
  if (channel < kAttitude) return "m/s^2";
  if (channel < kVelocity) return "rad";
  if (channel < kPosition) return "m/s";
  return channel < kRotorChannel ? "m" : "rad/s";
}

}  // namespace ident
