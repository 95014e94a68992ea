// Cosines over a window hold what is slow; angles of rotors are integrals of their speeds.
#include "ident/estimators/flight_tones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "ident/estimators/statistics.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// What may be motion: up to so many Hz, or such a share of what samples show.
constexpr double kMotion = 60.0, kShareOfMotion = 0.45;
constexpr Index kFewest = 30;     // samples of a window,
constexpr Index kFewestFast = 8;  // and of them more than the slow part has columns
constexpr double kIdle = 0.2;     // of the usual speed; slower rotors are not looked at

// Hz up to which samples may show motion.
double fastest_motion(const FlightRecord& record) {
  return std::min(kMotion, kShareOfMotion / (2 * record.interval));
}

// Speeds of the rotors at the rows of an arc, rad/s.
std::vector<std::vector<double>> speeds_of(const FlightArc& arc, int rotors) {
  std::vector<std::vector<double>> out(static_cast<std::size_t>(rotors));
  for (std::size_t n = 0; n < out.size(); ++n) {
    if (n < arc.inputs->Omega.size() && arc.inputs->Omega[n].size() == arc.rows()) {
      out[n] = arc.inputs->Omega[n];
    } else {
      out[n].resize(arc.rows());
      for (std::size_t i = 0; i < arc.rows(); ++i) out[n][i] = arc.start[i].motors[n].Omega;
    }
  }
  return out;
}

std::vector<double> angle_of(const std::vector<double>& t, const std::vector<double>& speed) {
  std::vector<double> out(t.size(), 0.0);
  for (std::size_t i = 1; i < t.size(); ++i)
    out[i] = out[i - 1] + 0.5 * (t[i] - t[i - 1]) * (speed[i] + speed[i - 1]);
  return out;
}

// Cosines over samples (DCT-II), slow ones first, by how many samples there are: where some were lost they
// are as smooth.
using Cosines = std::map<Index, std::shared_ptr<const MatrixXd>>;

const std::shared_ptr<const MatrixXd>& slow_cosines(Cosines& cache, Index samples, Index slow) {
  std::shared_ptr<const MatrixXd>& found = cache[samples];
  if (found) return found;
  MatrixXd out(samples, slow);
  for (Index i = 0; i < samples; ++i)
    for (Index k = 0; k < slow; ++k)
      out(i, k) = std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(i) + 0.5) /
                           static_cast<double>(samples));
  out.colwise().normalize();
  return found = std::make_shared<const MatrixXd>(std::move(out));
}

// The window of those rows; without samples where they are too few.
ToneWindow window_of(const FlightArc& arc, std::vector<std::size_t> rows, int group, Index slow,
                     Cosines& cosines) {
  ToneWindow w;
  const auto samples = static_cast<Index>(rows.size());
  if (samples < std::max(kFewest, slow + kFewestFast)) return w;
  w.rows = std::move(rows);
  w.y.resize(samples, 3);
  for (Index s = 0; s < samples; ++s)
    for (Index c = 0; c < 3; ++c)
      w.y(s, c) =
          arc.y[w.rows[static_cast<std::size_t>(s)] * kChannels + static_cast<std::size_t>(group + c)];
  w.slow = slow_cosines(cosines, samples, slow);
  return w;
}

// Noise of the axes by what is faster than motion, and which share of each slow cosine is motion.
void weigh(const FlightRecord& record, ToneWindows& sensor, const Eigen::Vector3d* sigma) {
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  double left = 0;
  std::vector<MatrixXd> slow(static_cast<std::size_t>(record.logs));  // [log][column][axis] squares
  std::vector<double> count(slow.size(), 0.0);
  for (const ToneWindow& w : sensor.windows) {
    const auto log = static_cast<std::size_t>(record.arcs[w.arc].log);
    const MatrixXd c = w.slow->transpose() * w.y;
    square += (w.y.colwise().squaredNorm() - c.colwise().squaredNorm()).transpose();
    left += static_cast<double>(w.slow->rows() - w.slow->cols());
    slow[log] = count[log] == 0 ? MatrixXd(c.cwiseAbs2()) : MatrixXd(slow[log] + c.cwiseAbs2());
    count[log] += 1;
  }
  if (sigma)
    sensor.sigma = *sigma;
  else if (left > 0)
    sensor.sigma = (square / left).cwiseMax(1e-24).cwiseSqrt();
  for (std::size_t log = 0; log < slow.size(); ++log) {
    const Eigen::RowVector3d noise = sensor.sigma.cwiseAbs2().transpose() * count[log];
    // Motion fades with frequency; what rises again is a tone.
    for (Index k = 2; k < slow[log].rows(); ++k)
      slow[log].row(k) = slow[log].row(k).cwiseMin(slow[log].row(k - 1)).eval();
    for (Index k = 0; k < slow[log].rows(); ++k)
      slow[log].row(k) = (1 - noise.array() / slow[log].row(k).array().max(1e-300)).max(0.0);
  }
  for (ToneWindow& w : sensor.windows) {
    w.taken = slow[static_cast<std::size_t>(record.arcs[w.arc].log)];
    w.y *= sensor.sigma.cwiseInverse().asDiagonal();
    w.told.resize(w.y.rows(), 3);
    for (Index axis = 0; axis < 3; ++axis) w.told.col(axis) = w.weighted(w.y.col(axis), axis);
  }
}

}  // namespace

ToneWindows tone_windows(const FlightRecord& record, int group, double seconds, double begin,
                         const Eigen::Vector3d* sigma) {
  ToneWindows out;
  Cosines cosines;
  const auto slow = static_cast<Index>(std::ceil(2 * fastest_motion(record) * seconds)) + 1;
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    const auto is_sampled = [&](std::size_t i) {
      const double* y = &arc.y[i * kChannels + static_cast<std::size_t>(group)];
      return std::isfinite(y[0]) && std::isfinite(y[1]) && std::isfinite(y[2]);
    };
    double from = arc.t.front() + begin;
    for (std::size_t i = 0; i < arc.rows(); from += seconds) {
      std::vector<std::size_t> rows;
      for (; i < arc.rows() && arc.t[i] < from + seconds; ++i)
        if (is_sampled(i)) rows.push_back(i);
      if (ToneWindow w = window_of(arc, std::move(rows), group, slow, cosines); !w.rows.empty())
        w.arc = a, out.windows.push_back(std::move(w));
    }
  }
  weigh(record, out, sigma);
  return out;
}

bool has_uneven_spectrum(const FlightRecord& record, int group) {
  constexpr std::size_t kLength = 64;
  constexpr double kBeyondDoubt = 6.0;  // standard deviations of a mean of periodograms
  constexpr double kSlow = 20.0;        // Hz below which motion stands out
  std::array<std::vector<double>, 3> power;
  double count = 0, samples = 0;
  std::array<double, kLength> hann{};
  for (std::size_t i = 0; i < kLength; ++i)
    hann[i] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / kLength);
  Eigen::FFT<double> fft;
  for (std::size_t c = 0; c < 3; ++c) {
    power[c].assign(kLength / 2 + 1, 0.0);
    std::vector<double> block, windowed(kLength);
    std::vector<std::complex<double>> spectrum;
    for (const FlightArc& arc : record.arcs) {
      block.clear();
      for (std::size_t i = 0; i < arc.rows(); ++i) {
        const double y = arc.y[i * kChannels + static_cast<std::size_t>(group) + c];
        if (std::isfinite(y)) block.push_back(y), samples += 1;
        if (block.size() < kLength) continue;
        for (std::size_t k = 0; k < kLength; ++k) windowed[k] = (block[k] - block[0]) * hann[k];
        fft.fwd(spectrum, windowed);
        for (std::size_t k = 0; k < power[c].size(); ++k) power[c][k] += std::norm(spectrum[k]);
        block.clear(), count += 1;
      }
    }
  }
  const double blocks = count / 3, rate = samples / 3 / record.duration;
  const auto first = static_cast<std::size_t>(std::ceil(std::min(kSlow, 0.2 * rate) / rate * kLength)) + 1;
  if (blocks < 8 || first + 4 > kLength / 2) return false;
  return std::ranges::any_of(power, [&](const std::vector<double>& p) {
    const std::vector<double> fast(p.begin() + static_cast<std::ptrdiff_t>(first), p.end() - 1);
    return std::ranges::max(fast) > (1 + kBeyondDoubt / std::sqrt(blocks)) * median(fast);
  });
}

TurningRotors::TurningRotors(const FlightRecord& record)
    : record_(&record), count_(record.layout.rotors), measured_(record.signals.rotor_speeds) {
  double sum = 0, n = 0;
  for (const FlightArc& arc : record.arcs) {
    speed_.push_back(speeds_of(arc, count_));
    angle_.emplace_back();
    for (const std::vector<double>& speed : speed_.back()) {
      angle_.back().push_back(angle_of(arc.t, speed));
      for (const double x : speed) sum += x, n += 1;
    }
  }
  usual_ = sum / n;
}

Eigen::ArrayXXcd TurningRotors::turned(const ToneWindow& window, double scale) const {
  Eigen::ArrayXXcd out(static_cast<Index>(window.rows.size()), count_);
  for (Index n = 0; n < count_; ++n) {
    const std::vector<double>& angle = angle_[window.arc][static_cast<std::size_t>(n)];
    for (Index i = 0; i < out.rows(); ++i)
      out(i, n) =
          std::polar(1.0, scale * (angle[window.rows[static_cast<std::size_t>(i)]] - angle[window.rows[0]]));
  }
  return out;
}

Eigen::VectorXd TurningRotors::sizes(const ToneWindow& window) const {
  Eigen::VectorXd out(count_);
  for (Index n = 0; n < count_; ++n) {
    double mean = 0;
    for (const std::size_t row : window.rows) mean += speed_[window.arc][static_cast<std::size_t>(n)][row];
    const double share = mean / static_cast<double>(window.rows.size()) / usual_;
    out[n] = share < kIdle ? 0.0 : share * share;
  }
  return out;
}

Eigen::VectorXd TurningRotors::folded(const ToneWindow& window, int order, double scale) const {
  const std::vector<double>& t = record_->arcs[window.arc].t;
  const std::size_t first = window.rows.front(), last = window.rows.back();
  const double span = t[last] - t[first], rate = static_cast<double>(window.rows.size() - 1) / span;
  Eigen::VectorXd out(count_);
  for (Index n = 0; n < count_; ++n) {
    const std::vector<double>& angle = angle_[window.arc][static_cast<std::size_t>(n)];
    const double hz = order * scale * (angle[last] - angle[first]) / (2 * std::numbers::pi * span);
    out[n] = std::abs(hz - std::round(hz / rate) * rate);
  }
  return out;
}

}  // namespace ident
