// Periodograms of stretches of a series, summed (Welch's method).
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace ident {

/// Sums periodograms of stretches of one length under a Hann window.
/// Welch, The use of fast Fourier transform for the estimation of power spectra, 1967.
class Periodograms {
 public:
  explicit Periodograms(std::size_t length);

  /// `stretch` has `length` samples, from which `level` is taken first.
  void add(std::span<const double> stretch, double level);

  std::size_t length() const { return window_.size(); }
  /// |transform|^2, summed over the stretches; entry k at frequency k/(length h), h the sampling interval.
  const std::vector<double>& power() const { return power_; }
  double count() const { return count_; }  ///< stretches
  /// Sum of the squared window: white noise of variance s^2 has mean power s^2 times this in each entry.
  double weight() const { return weight_; }

 private:
  std::vector<double> window_, power_, windowed_;
  std::vector<std::complex<double>> transform_;
  Eigen::FFT<double> fft_;
  double weight_ = 0.0, count_ = 0.0;
};

}  // namespace ident
