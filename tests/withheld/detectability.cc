// Signatures are whitened in the frequency domain with the spectra of sensors and turbulence.
//
// Along the flown trajectory (true motion, logged commands) the instruments' readings are predicted with the
// true vehicle; a signature s is what changes when the effect is taken away, a nuisance column what changes
// with one standard deviation of a base parameter. With the Fourier transforms over a log of N samples at
// rate f_s,
//
//   <a, b> = sum over logs, bins f and channels of  a(f)^* S(f)^-1 b(f) / (N f_s)                       (1)
//   lambda = <s, s> - <s, B> (<B, B> + I)^-1 <B, s>         I: the priors of the base parameters         (2)
//   size / limit = sqrt(lambda / lambda_0)      lambda_0: 90 % power at level 0.01/21                    (3)
//
// S is the spectrum of: accelerometer noise; velocity noise, differentiated, in parallel with position noise,
// twice differentiated; gyro noise, differentiated; attitude noise, twice differentiated; the accelerations
// of light turbulence, common to both instruments of a pair; rotor speed noise. Gyro biases drop out by the
// differentiation. States are free anew every half second, the horizon over which a gap is measured: the
// slope of N samples with noise sigma over T has the variance 12 sigma^2/(N T^2), as if the noise of a
// differentiated channel never fell below its value at sqrt(12)/(2 pi T) = 1.1 Hz. A cosine taper keeps the
// ends of the log out of all bins.
#include "detectability.h"

#include <cmath>
#include <unsupported/Eigen/FFT>

#include "chi_squared.h"

namespace withheld {

namespace {

using Eigen::Index;
using Eigen::VectorXcd;

constexpr double kLowest = 1.1;  // Hz
constexpr double kTaper = 0.08;  // of the log at each end

Eigen::VectorXd taper(Index n) {
  Eigen::VectorXd w = Eigen::VectorXd::Ones(n);
  const auto edge = static_cast<Index>(kTaper * static_cast<double>(n));
  for (Index i = 0; i < edge; ++i) {
    w[i] = w[n - 1 - i] =
        0.5 * (1 - std::cos(M_PI * (static_cast<double>(i) + 0.5) / static_cast<double>(edge)));
  }
  return w;
}

// Spectra of two instruments that see the same motion, each with its own noise.
struct Pair {
  double first, second, common;
};

Pair force_noise(const Effects& e, const Instruments& i, const GustSettings& gusts, double hz) {
  const double w = 2 * M_PI * std::max(hz, kLowest), position_rate = i.rate / i.position_every;
  const double by_velocity = i.velocity * i.velocity * w * w / position_rate;
  const double by_position = i.position * i.position * std::pow(w, 4) / position_rate;
  return {i.acc * i.acc / i.rate, 1 / (1 / by_velocity + 1 / by_position),
          e.gust_grip * e.gust_grip * gust_spectrum(gusts, hz)};
}

Pair turn_noise(const Vehicle& v, const Effects& e, const Instruments& i, const GustSettings& gusts,
                double hz, int axis) {
  const double w = 2 * M_PI * std::max(hz, kLowest);
  const double lever = axis == 2 ? 0 : v.m * e.gust_grip * e.gust_arm / v.J[axis];
  return {i.gyro * i.gyro * w * w / i.rate, i.attitude * i.attitude * std::pow(w, 4) / i.rate,
          lever * lever * gust_spectrum(gusts, hz)};
}

class Whitener {
 public:
  Whitener(Index rows, double rate) : window_(taper(rows)), rate_(rate) {
    fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  }

  Index bins() const { return window_.size() / 2 + 1; }
  double hz(Index bin) const {
    return rate_ * static_cast<double>(bin) / static_cast<double>(window_.size());
  }

  VectorXcd transform(const Eigen::VectorXd& x) {
    if (x.isZero(0)) return VectorXcd::Zero(bins());
    const Eigen::VectorXd tapered = x.cwiseProduct(window_);
    VectorXcd result;
    fft_.fwd(result, tapered);
    const double scale = 1 / std::sqrt(static_cast<double>(window_.size()) * rate_);
    result *= scale * std::sqrt(2.0);
    result[0] /= std::sqrt(2.0);
    return result;
  }

 private:
  Eigen::FFT<double> fft_;
  Eigen::VectorXd window_;
  double rate_;
};

}  // namespace

void Gram::add(const std::vector<Channels>& signatures, const Vehicle& v, const Effects& e,
               const Instruments& i, const GustSettings& gusts, double rate) {
  Whitener whitener(signatures.front().rows(), rate);
  const Index bins = whitener.bins(), columns = G_.cols();
  Eigen::MatrixXd rows(4 * bins, columns);
  const auto accumulate = [&](Index used) {
    G_.selfadjointView<Eigen::Lower>().rankUpdate(rows.topRows(used).transpose());
  };
  for (int pair = 0; pair < 6; ++pair) {
    const int axis = pair % 3, first = pair < 3 ? axis : 6 + axis, second = first + 3;
    std::vector<Pair> noise;
    for (Index k = 0; k < bins; ++k) {
      noise.push_back(pair < 3 ? force_noise(e, i, gusts, whitener.hz(k))
                               : turn_noise(v, e, i, gusts, whitener.hz(k), axis));
    }
    for (Index c = 0; c < columns; ++c) {
      const Channels& s = signatures[static_cast<std::size_t>(c)];
      VectorXcd a = whitener.transform(s.col(first)), b = whitener.transform(s.col(second));
      for (Index k = 0; k < bins; ++k) {
        const Pair& n = noise[static_cast<std::size_t>(k)];
        const double l11 = std::sqrt(n.first + n.common), l21 = n.common / l11;
        a[k] /= l11;
        b[k] = (b[k] - l21 * a[k]) / std::sqrt(n.second + n.common - l21 * l21);
      }
      rows.col(c) << a.real(), a.imag(), b.real(), b.imag();
    }
    accumulate(4 * bins);
  }
  if (i.rotor_speeds) {
    const double noise = i.speed_share * v.hover_speed() / std::sqrt(i.rate);
    for (int rotor = 0; rotor < kRotors; ++rotor) {
      for (Index c = 0; c < columns; ++c) {
        const VectorXcd a =
            whitener.transform(signatures[static_cast<std::size_t>(c)].col(12 + rotor)) / noise;
        rows.col(c).head(2 * bins) << a.real(), a.imag();
      }
      accumulate(2 * bins);
    }
  }
  const Eigen::MatrixXd whole = G_.selfadjointView<Eigen::Lower>();
  G_ = whole;
}

double Gram::left(Index signature, const std::vector<Index>& nuisances) const {
  const auto n = static_cast<Index>(nuisances.size());
  Eigen::MatrixXd A(n, n);
  Eigen::VectorXd b(n), scale(n);
  for (Index i = 0; i < n; ++i) {
    const Index from = nuisances[static_cast<std::size_t>(i)];
    scale[i] = 1 / std::sqrt(std::max(G_(from, from), 1e-300));
  }
  for (Index i = 0; i < n; ++i) {
    const Index row = nuisances[static_cast<std::size_t>(i)];
    b[i] = G_(row, signature) * scale[i];
    for (Index j = 0; j < n; ++j)
      A(i, j) = G_(row, nuisances[static_cast<std::size_t>(j)]) * scale[i] * scale[j];
    A(i, i) += 1e-10;
  }
  return std::max(0.0, G_(signature, signature) - (n > 0 ? b.dot(A.ldlt().solve(b)) : 0));
}

double required_noncentrality(int freedom) { return noncentrality_for(freedom, 0.01 / 21, 0.9); }

}  // namespace withheld
