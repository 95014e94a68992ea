// Narrow lines in what a model leaves over: a load that swings, an arm that bends, a blade out of balance.
#pragma once

#include <string>
#include <vector>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// A peak that no smooth spectrum has, at less than one chance in ten thousand over all channels.
struct SpectralLine {
  std::string channel;  ///< of a measurement, or Fx to Mz of the accelerations from outside
  double hz = 0.0;
  double height = 0.0;     ///< over the spectrum around it
  double share = 0.0;      ///< of the channel's residual variance
  double rotor_hz = kNaN;  ///< turns of the rotors a second, where the IMU may show their vibration: as
                           ///< often, or folded by the rate at which it was sampled
};

/// Lines of the weighted residuals and of the accelerations that the smoother of `fit` holds, strongest
/// first.
std::vector<SpectralLine> spectral_lines(const FlightRecord& record, const FlightFit& fit);

}  // namespace ident
