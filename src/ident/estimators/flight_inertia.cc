// Jxx + Jyy >= Jzz and so on in turn, with the covariance of the fit.
#include "ident/estimators/flight_inertia.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "ident/core/format_number.h"

namespace ident {
namespace {

// Below so many standard deviations it is chance, in a body that is nearly flat.
constexpr double kByChance = 2.0;

}  // namespace

void warn_of_inertia(Result& result, const Theta& theta, const FlightFit& fit) {
  constexpr std::array moments{param::Jxx, param::Jyy, param::Jzz};
  constexpr std::array names{"Jxx", "Jyy", "Jzz"};
  const std::vector<double> p = theta.p(fit.u);
  for (std::size_t c = 0; c < 3; ++c) {
    double margin = 0;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(theta.size());
    for (std::size_t k = 0; k < 3; ++k) {
      const double sign = k == c ? -1.0 : 1.0;
      margin += sign * p[static_cast<std::size_t>(moments[k])];
      for (int i = 0; i < theta.constants_count(); ++i)
        if (theta.constants()[static_cast<std::size_t>(i)].index == moments[k])
          slope[i] = sign * theta.slope(fit.u, i);
    }
    if (margin >= 0) continue;
    const double std = std::sqrt(slope.dot(fit.covariance * slope)), by = -margin / std;
    if (!(std > 0)) continue;  // as stated, and nobody asked the flight
    const std::size_t a = (c + 1) % 3, b = (c + 2) % 3;
    const double sum = p[static_cast<std::size_t>(moments[a])] + p[static_cast<std::size_t>(moments[b])];
    result.warn("triangle_inequality",
                fmt::format("{} = {} exceeds {} + {} = {} kg m^2, which no body does, by {} standard "
                            "deviations: {}",
                            names[c], format_number(p[static_cast<std::size_t>(moments[c])]), names[a],
                            names[b], format_number(sum), format_number(by, 2),
                            by < kByChance ? "by chance, if the vehicle is nearly flat"
                                           : "another constant is wrong (arm, kQ, mass), or an effect is "
                                             "missing"));
  }
}

}  // namespace ident
