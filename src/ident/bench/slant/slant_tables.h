// Tables and curves of a slant angle: allocation, price, mounting error.
#pragma once

#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

/// The four inputs in all six channels, per newton of vertical thrust on each rotor that an input raises.
Table allocation_table(const Vehicle& vehicle, double alpha);
nlohmann::ordered_json allocation_json(const Vehicle& vehicle, double alpha);

/// What is paid at an angle, everything relative to one rotor's vertical thrust t and the arm l.
struct SlantPrice {
  double lift;           ///< thrust of a slanted rotor over its vertical part
  double yaw_authority;  ///< yaw moment of the yaw input over l t
  double yaw_leak;       ///< yaw moment of the heave input over l t: 0 where it decouples
  double sideways;       ///< force along x of the roll input over t
};
SlantPrice slant_price(const Vehicle& vehicle, double arm, double alpha);

/// Yaw input that holds the yaw moment at hover when the slanted rotors are off by `error`, relative to the
/// hover thrust of a rotor.
double mounting_trim(const Vehicle& vehicle, double arm, double alpha, double error);

/// Price over the angle, with the optimum marked.
std::vector<Plot> slant_plots(const Vehicle& vehicle, double arm, double alpha_opt);

}  // namespace ident
