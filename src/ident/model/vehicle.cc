// Named layouts and default values of the constants.
#include "ident/model/vehicle.h"

#include "ident/core/error.h"

namespace ident {
namespace {

using Eigen::Vector3d;

std::vector<Rotor> plus_rotors(double l) {
  const Vector3d up(0, 0, -1), none(0, 0, 0);
  return {{{l, 0, 0}, up, +1, none},
          {{0, -l, 0}, up, -1, none},
          {{-l, 0, 0}, up, +1, none},
          {{0, l, 0}, up, -1, none}};
}

std::vector<Rotor> x_rotors(double l) {
  const double d = l / std::sqrt(2.0);
  const Vector3d up(0, 0, -1), none(0, 0, 0);
  return {{{d, d, 0}, up, +1, none},
          {{d, -d, 0}, up, -1, none},
          {{-d, -d, 0}, up, +1, none},
          {{-d, d, 0}, up, -1, none}};
}

// [Phang]: the places of plus, all counter-clockwise, left and right rotor slanted about their arms.
std::vector<Rotor> slanted_rotors(double l, double alpha) {
  std::vector<Rotor> rotors = plus_rotors(l);
  for (Rotor& rotor : rotors) rotor.s = +1;
  rotors[1].slant_B = Vector3d(-1, 0, 0);
  rotors[3].slant_B = Vector3d(1, 0, 0);
  for (Rotor& rotor : rotors) rotor.a_B = axis_at(rotor, alpha);
  return rotors;
}

}  // namespace

std::vector<Rotor> layout_rotors(const std::string& layout, double arm, double slant) {
  if (layout == "plus") return plus_rotors(arm);
  if (layout == "x") return x_rotors(arm);
  if (layout == "4sp") return slanted_rotors(arm, slant);
  throw UsageError("unknown layout '" + layout + "': use plus, x or 4sp");
}

}  // namespace ident
