// Names of channels, and what a record has to hold.
#include "ident/flight/record/flight_record.h"

#include <fmt/format.h>

#include <array>

#include "ident/core/error.h"

namespace ident {

void require_turning(const Signals& logged) {
  if (!logged.rates && !logged.attitude && (logged.velocity || logged.position))
    throw DataError(
        "neither rates nor attitude were logged: from the path alone it cannot be told how the vehicle "
        "turned, and so not what its rotors did; log one of them");
}

std::string channel_name(int channel) {
  static constexpr std::array names = {"p",          "q",  "r",  "ax", "ay", "az", "attitude x", "attitude y",
                                       "attitude z", "vx", "vy", "vz", "x",  "y",  "z"};
  if (channel < kRotorChannel) return names[static_cast<std::size_t>(channel)];
  return fmt::format("omega{}", channel - kRotorChannel + 1);
}

}  // namespace ident
