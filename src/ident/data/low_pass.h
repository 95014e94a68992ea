// The low-pass filters that a maker puts before what is logged.
#pragma once

namespace ident {

/// A low-pass to second order: y + lag y' + square y'' is what went in. Of filters in a row the lags add up.
struct LowPass {
  double lag = 0.0;     ///< s
  double square = 0.0;  ///< s^2

  double corner() const;  ///< Hz; infinite without one
};

/// Butterworth of second order (LowPassFilter2p of PX4, ArduPilot and the Crazyflie): lag sqrt(2)/w and
/// square 1/w^2 with w = 2 pi `cutoff` Hz.
LowPass butterworth(double cutoff);

/// The filter that both in a row are.
LowPass in_a_row(const LowPass& first, const LowPass& second);

}  // namespace ident
