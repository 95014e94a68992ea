// Can a body have this inertia?
//
//   J = integral (r^2 I - r r^T) dm  <=>  S = tr(J)/2 I - J = integral r r^T dm is positive semi-definite (1)
//
// In principal axes (1) is the triangle inequality J1 + J2 >= J3: no moment exceeds the sum of the others.
#include "ident/bench/check/consistency_inertia.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/model/arm_length.h"

namespace ident {
namespace {

const std::array<std::string, 3> kMoments = {"Jxx", "Jyy", "Jzz"};

Eigen::Matrix3d inertia(const Vehicle& vehicle) {
  Eigen::Matrix3d J;
  const double xy = vehicle.value("Jxy"), xz = vehicle.value("Jxz"), yz = vehicle.value("Jyz");
  J << vehicle.value("Jxx"), xy, xz, xy, vehicle.value("Jyy"), yz, xz, yz, vehicle.value("Jzz");
  return J;
}

/// Standard deviation of J_a + J_b - J_c when all three state one.
double margin_std(const Vehicle& vehicle) {
  double sum = 0.0;
  for (const std::string& name : kMoments) {
    const Known& known = vehicle.parameters.at(name);
    if (!known.std) return kNaN;
    sum += *known.std * *known.std;
  }
  return std::sqrt(sum);
}

/// The triangle inequality on the three moments as the file states them, named as there.
void check_triangle(const Vehicle& vehicle, Consistency& found) {
  const std::string what = "triangle inequality";
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string &a = kMoments[(c + 1) % 3], &b = kMoments[(c + 2) % 3];
    const double sum = vehicle.value(a) + vehicle.value(b), largest = vehicle.value(kMoments[c]);
    if (sum >= largest) continue;
    const double std = margin_std(vehicle);
    const std::string text = fmt::format("{} + {} = {} < {} = {} kg m^2", a, b, format_number(sum),
                                         kMoments[c], format_number(largest));
    if (std::isfinite(std) && largest - sum < 2.0 * std)
      return found.doubtful(what, {"triangle_inequality",
                                   text + fmt::format(", by {:.1f} standard deviations: measure them better",
                                                      (largest - sum) / std)});
    return found.violated(
        what,
        {"triangle_inequality",
         text + ": no body has these moments",
         {{a, vehicle.value(a)}, {b, vehicle.value(b)}, {kMoments[c], largest}, {"sum", sum}, {"std", std}}});
  }
  found.ok(what, fmt::format("Jxx {}, Jyy {}, Jzz {} kg m^2", format_number(vehicle.value("Jxx")),
                             format_number(vehicle.value("Jyy")), format_number(vehicle.value("Jzz"))));
}

/// (1) with the products of inertia: only worth saying where they decide.
void check_principal(const Vehicle& vehicle, Consistency& found) {
  const Eigen::Matrix3d J = inertia(vehicle);
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J).eigenvalues();
  const std::string numbers = fmt::format("principal moments {}, {}, {} kg m^2", format_number(principal[0]),
                                          format_number(principal[1]), format_number(principal[2]));
  const nlohmann::ordered_json values = {{"principal", {principal[0], principal[1], principal[2]}}};
  if (principal[0] <= 0.0)
    return found.violated(
        "inertia positive definite",
        {"inertia_not_positive", "the inertia is not positive definite: " + numbers, values});
  found.ok("inertia positive definite", numbers);
  const bool own_axes_fine = J.diagonal().sum() >= 2.0 * J.diagonal().maxCoeff();
  if (own_axes_fine && principal[0] + principal[1] < principal[2])
    found.violated("triangle inequality of principal moments",
                   {"triangle_inequality", "with its products the inertia fails: " + numbers, values});
}

/// Radius of gyration against the arm: a slip of units is a factor of 10 or more.
void check_size(const Vehicle& vehicle, Consistency& found) {
  const std::string what = "size of the inertia";
  const std::optional<Known> arm = arm_length(vehicle);
  if (!arm || !(arm->value > 0.0) || !vehicle.has("m") || !(vehicle.value("m") > 0.0))
    return found.cannot_be_judged(what, "mass and arm");
  for (const std::string& name : kMoments) {
    const double ratio = std::sqrt(vehicle.value(name) / vehicle.value("m")) / arm->value;
    if (ratio > 0.05 && ratio < 1.5) continue;
    return found.violated(
        what, {"implausible_inertia",
               fmt::format("{} = {} kg m^2 puts the mass at {} arm lengths from the axis (0.05 to 1.5 is "
                           "plausible): units?",
                           name, format_number(vehicle.value(name)), format_number(ratio, 3)),
               {{name, vehicle.value(name)},
                {"m", vehicle.value("m")},
                {"l", arm->value},
                {"radius_of_gyration_over_arm", ratio}}});
  }
  found.ok(what,
           fmt::format("radius of gyration about z is {} arm lengths",
                       format_number(std::sqrt(vehicle.value("Jzz") / vehicle.value("m")) / arm->value, 3)));
}

}  // namespace

void check_inertia(const Vehicle& vehicle, Consistency& found) {
  for (const std::string& name : kMoments)
    if (!vehicle.has(name)) return found.cannot_be_judged("inertia", "Jxx, Jyy and Jzz");
  for (const std::string& name : kMoments)
    if (!(vehicle.value(name) > 0.0)) return;  // said by check_values
  check_principal(vehicle, found);
  check_triangle(vehicle, found);
  check_size(vehicle, found);
}

}  // namespace ident
