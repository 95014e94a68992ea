// What is stated goes before what rotors' places say.
#include "ident/model/arm_length.h"

namespace ident {

std::optional<Known> arm_length(const Vehicle& vehicle) {
  if (vehicle.has("l")) return vehicle.parameters.at("l");
  if (vehicle.arm) return Known{*vehicle.arm, {}};
  double sum = 0.0;
  for (const Rotor& rotor : vehicle.rotors) sum += rotor.r_B.head<2>().norm();
  if (!(sum > 0.0)) return std::nullopt;
  return Known{sum / static_cast<double>(vehicle.rotors.size()), {}};
}

}  // namespace ident
