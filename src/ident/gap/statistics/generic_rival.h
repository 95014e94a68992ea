// The rival of every named cause: a plain regression of the missing accelerations on what the flight shows.
#pragma once

#include <array>

#include "ident/gap/statistics/residual_wrench.h"

namespace ident {

/// What a regression on velocity, rates, rotor speeds, attitude, height, voltage, time and the recent past
/// predicts beyond a model, as fall of the cost (twice the log likelihood) on blocks that it was not fitted
/// to. Below 0: it only follows noise.
struct Rival {
  bool judged = false;           ///< there was flight enough
  std::array<double, 6> gain{};  ///< Fx Fy Fz Mx My Mz
  /// The same for what each sensor shows beyond the model, by name of its channel.
  std::vector<std::pair<std::string, double>> sensors;
  double total() const;           ///< of the channels that gain
  std::string strongest() const;  ///< name of the channel that gains most
};

/// The rival of a fitted model under the noise `floor`; `wrench` is that of the model.
Rival generic_rival(const FlightRecord& record, const Theta& theta, const FlightFit& fit,
                    const NoiseModel& floor);

}  // namespace ident
