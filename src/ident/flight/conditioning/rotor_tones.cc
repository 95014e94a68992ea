// Cosines over a window hold what is slow; angles of rotors are integrals of their speeds.
#include "ident/flight/conditioning/rotor_tones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "ident/core/periodograms.h"
#include "ident/core/statistics.h"
#include "ident/flight/conditioning/windowed_changes.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kSamples = 40;  // of a window that tells something,
constexpr Index kFewest = 32;   // and of one in which some were lost
constexpr double kIdle = 0.2;   // of the usual speed; slower rotors are not looked at

bool were_measured(const FlightArc& arc, std::size_t rotor) {
  return rotor < arc.inputs->Omega.size() && arc.inputs->Omega[rotor].size() == arc.rows();
}

// Speeds of the rotors at the rows of an arc, rad/s.
std::vector<std::vector<double>> speeds_of(const FlightArc& arc, int rotors) {
  std::vector<std::vector<double>> out(static_cast<std::size_t>(rotors));
  for (std::size_t n = 0; n < out.size(); ++n) {
    if (were_measured(arc, n)) {
      out[n] = arc.inputs->Omega[n];
    } else {
      out[n].resize(arc.rows());
      for (std::size_t i = 0; i < arc.rows(); ++i) out[n][i] = arc.motors[i * arc.rotors() + n].Omega;
    }
  }
  return out;
}

// Which rows of a sensor were sampled, of all axes that ever were.
class Sampled {
 public:
  Sampled(const FlightRecord& record, int group) : group_(static_cast<std::size_t>(group)) {
    for (const FlightArc& arc : record.arcs)
      for (std::size_t i = 0; i < arc.rows(); ++i)
        for (std::size_t c = 0; c < 3; ++c) axes_[c] |= std::isfinite(arc.y[i * kChannels + group_ + c]);
  }
  bool operator()(const FlightArc& arc, std::size_t i) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (axes_[c] && !std::isfinite(arc.y[i * kChannels + group_ + c])) return false;
    return axes_[0] || axes_[1] || axes_[2];
  }
  double value(const FlightArc& arc, std::size_t i, std::size_t axis) const {
    return axes_[axis] ? arc.y[i * kChannels + group_ + axis] : 0.0;
  }

 private:
  std::size_t group_;
  std::array<bool, 3> axes_{};
};

// Usual time between samples, s; 0 without any.
double usual_interval(const FlightRecord& record, const Sampled& is_sampled) {
  std::vector<double> intervals;
  for (const FlightArc& arc : record.arcs) {
    double last = kNaN;
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      if (!is_sampled(arc, i)) continue;
      if (std::isfinite(last)) intervals.push_back(arc.t[i] - last);
      last = arc.t[i];
    }
  }
  return intervals.empty() ? 0.0 : median(intervals);
}

// Cosines over samples (DCT-II) by how many samples there are: where some were lost they are as smooth.
using Cosines = std::map<Index, std::shared_ptr<const MatrixXd>>;

const std::shared_ptr<const MatrixXd>& cosines_over(Cosines& cache, Index samples) {
  std::shared_ptr<const MatrixXd>& found = cache[samples];
  if (found) return found;
  MatrixXd out(samples, samples);
  for (Index i = 0; i < samples; ++i)
    for (Index k = 0; k < samples; ++k)
      out(i, k) = std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(i) + 0.5) /
                           static_cast<double>(samples));
  out.colwise().normalize();
  return found = std::make_shared<const MatrixXd>(std::move(out));
}

// A spectrum that fades: the median of neighbours, and never more than at what is slower. What rises again is
// a tone.
void fade(Eigen::Ref<Eigen::VectorXd> power) {
  constexpr Index kNeighbours = 3, kSlowestTones = 3;
  const Eigen::VectorXd raw = power;
  for (Index k = kSlowestTones; k < raw.size(); ++k) {
    const Index half = std::min({kNeighbours, k - kSlowestTones, raw.size() - 1 - k});
    std::vector<double> near(raw.data() + k - half, raw.data() + k + half + 1);
    power[k] = std::min(median(near), power[k - 1]);
  }
}

// The spectrum of each log gives the noise of the axes, by what is fastest, and the share of each cosine that
// is more than that. Windows last alike, whether samples were lost in them or not.
void weigh(const FlightRecord& record, ToneWindows& sensor, const Eigen::Vector3d* sigma) {
  Index most = 0;
  for (const ToneWindow& w : sensor.windows) most = std::max(most, w.y.rows());
  if (most == 0) return;
  std::vector<MatrixXd> power(static_cast<std::size_t>(record.logs), MatrixXd::Zero(most, 3));
  std::vector<Eigen::VectorXd> count(power.size(), Eigen::VectorXd::Zero(most));
  for (const ToneWindow& w : sensor.windows) {
    const auto log = static_cast<std::size_t>(record.arcs[w.arc].log);
    power[log].topRows(w.y.rows()) += (w.cosines->transpose() * w.y).cwiseAbs2();
    count[log].head(w.y.rows()).array() += 1;
  }
  Eigen::Vector3d fastest = Eigen::Vector3d::Zero();
  double windows = 0;
  for (std::size_t log = 0; log < power.size(); ++log) {
    if (count[log][0] == 0) continue;
    power[log].array().colwise() /= count[log].array().max(1.0);
    for (Index axis = 0; axis < 3; ++axis) fade(power[log].col(axis));
    Index last = most - 1;  // that windows usually have
    while (count[log][last] < 0.5 * count[log][0]) --last;
    fastest += count[log][0] * power[log].row(last).transpose(), windows += count[log][0];
  }
  sensor.sigma = sigma ? *sigma : Eigen::Vector3d((fastest / windows).cwiseSqrt());
  // An axis that hardly moves is not trusted beyond its sensor.
  sensor.sigma = sensor.sigma.cwiseMax(std::max(0.2 * sensor.sigma.maxCoeff(), 1e-12));
  for (ToneWindow& w : sensor.windows) {
    const MatrixXd& of_log = power[static_cast<std::size_t>(record.arcs[w.arc].log)];
    w.taken.resize(w.y.rows(), 3), w.told.resize(w.y.rows(), 3);
    w.y *= sensor.sigma.cwiseInverse().asDiagonal();
    for (Index axis = 0; axis < 3; ++axis) {
      const double noise = sensor.sigma[axis] * sensor.sigma[axis];
      for (Index k = 0; k < w.y.rows(); ++k)
        w.taken(k, axis) = std::max(1 - noise / std::max(of_log(k, axis), noise), 0.0);
      w.told.col(axis) = w.weighted(w.y.col(axis), axis);
    }
  }
}

}  // namespace

double folded(double hz, double sampled) { return std::abs(hz - std::round(hz / sampled) * sampled); }

ToneWindows tone_windows(const FlightRecord& record, int group, double seconds, double begin,
                         const Eigen::Vector3d* sigma) {
  ToneWindows out;
  const Sampled is_sampled(record, group);
  out.seconds = std::max(seconds, static_cast<double>(kSamples) * usual_interval(record, is_sampled));
  Cosines cosines;
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    double from = arc.t.front() + begin * out.seconds;
    for (std::size_t i = 0; i < arc.rows(); from += out.seconds) {
      ToneWindow w;
      w.arc = a;
      for (; i < arc.rows() && arc.t[i] < from + out.seconds; ++i)
        if (is_sampled(arc, i)) w.rows.push_back(i);
      const auto samples = static_cast<Index>(w.rows.size());
      if (samples < kFewest) continue;
      w.cosines = cosines_over(cosines, samples);
      w.y.resize(samples, 3);
      for (Index s = 0; s < samples; ++s)
        for (Index c = 0; c < 3; ++c)
          w.y(s, c) = is_sampled.value(arc, w.rows[static_cast<std::size_t>(s)], static_cast<std::size_t>(c));
      out.windows.push_back(std::move(w));
    }
  }
  weigh(record, out, sigma);
  return out;
}

bool has_uneven_spectrum(const FlightRecord& record, int channel) {
  constexpr std::size_t kLength = 64;
  constexpr double kBeyondDoubtTones = 6.0;  // standard deviations of a mean of periodograms
  constexpr double kSlow = 20.0;             // Hz below which motion stands out
  Periodograms blocks(kLength);
  std::vector<double> block;
  double samples = 0;
  for (const FlightArc& arc : record.arcs) {
    block.clear();
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      const double y = arc.y[i * kChannels + static_cast<std::size_t>(channel)];
      if (std::isfinite(y)) block.push_back(y), samples += 1;
      if (block.size() < kLength) continue;
      blocks.add(block, block.front());
      block.clear();
    }
  }
  const std::vector<double>& power = blocks.power();
  if (blocks.count() < 8) return false;
  const double rate = samples / record.duration;
  const auto first = static_cast<std::size_t>(std::ceil(std::min(kSlow, 0.2 * rate) / rate * kLength)) + 1;
  const std::vector<double> fast(power.begin() + static_cast<std::ptrdiff_t>(first), power.end() - 1);
  return std::ranges::max(fast) > (1 + kBeyondDoubtTones / std::sqrt(blocks.count())) * median(fast);
}

TurningRotors::TurningRotors(const FlightRecord& record)
    : record_(&record), count_(record.layout.rotors), measured_(true) {
  double sum = 0, n = 0;
  for (const FlightArc& arc : record.arcs) {
    for (int rotor = 0; rotor < count_; ++rotor)
      measured_ &= were_measured(arc, static_cast<std::size_t>(rotor));
    speed_.push_back(speeds_of(arc, count_));
    angle_.emplace_back();
    for (const std::vector<double>& speed : speed_.back()) {
      angle_.back().push_back(integral(arc.t, speed));
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
  std::vector<double> intervals;  // usual ones: some samples may be lost
  for (std::size_t i = 1; i < window.rows.size(); ++i)
    intervals.push_back(t[window.rows[i]] - t[window.rows[i - 1]]);
  const double rate = 1 / median(intervals);
  const std::size_t first = window.rows.front(), last = window.rows.back();
  Eigen::VectorXd out(count_);
  for (Index n = 0; n < count_; ++n) {
    const std::vector<double>& angle = angle_[window.arc][static_cast<std::size_t>(n)];
    const double turns = (angle[last] - angle[first]) / (2 * std::numbers::pi * (t[last] - t[first]));
    out[n] = ident::folded(order * scale * turns, rate);
  }
  return out;
}

}  // namespace ident
