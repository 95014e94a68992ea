// The slant angle that decouples: in closed form for equal rotors, and the best one for unequal rotors.
//
//   tan(alpha) = 2 kQ/(l kT)                                                    [Phang 24]          (1)
//
// (1) holds for equal rotors with equal vertical thrust at hover. For a vehicle as it is, the four unit
// inputs in vertical thrust give moments that are affine in x = tan(alpha), for T = t/cos(alpha) along
// cos(alpha) (x slant_B - z):
//
//   M_input(x) = M0 + x M1 ,  minimise  sum over inputs and unwanted moments of (M_input/(l t))^2         (2)
//   x_opt = - (sum M0 M1)/(sum M1 M1)
//
// Unwanted is every moment of the heave input, and of the others the moments about the two axes that are not
// theirs. Sideways forces do not count: no slant removes them (model README, erratum 3).
#pragma once

#include "ident/model/vehicle.h"

namespace ident {

/// Equation (1), rad.
double optimal_slant(double kT, double kQ, double arm);

/// Standard deviation of (1) from those of the three constants; `correlation` is that of kT and kQ.
double optimal_slant_std(const Known& kT, const Known& kQ, const Known& arm, double correlation);

/// Equation (2), rad; the vehicle's slanted rotors know their direction (`with_slant_directions`).
double best_slant(const Vehicle& vehicle, double arm);

/// Root of the sum in (2) at an angle: what stays coupled, relative to the moment of one unit at the arm.
double unwanted_moment(const Vehicle& vehicle, double arm, double alpha);

}  // namespace ident
