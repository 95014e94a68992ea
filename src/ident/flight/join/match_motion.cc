// Candidates by correlation of the sizes of rates, each refined along with the turn of the axes.
#include "ident/flight/join/match_motion.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/core/statistics.h"
#include "ident/flight/join/running_turn.h"

namespace ident {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Complex = std::complex<double>;

constexpr double kGrid = 0.02, kWide = 0.1;         // s: grid and windows of the correlation
constexpr double kFineGrid = 0.01, kNarrow = 0.06;  // s: the same of the steps
constexpr double kLeast = 10.0;                     // s of both that have to overlap, or half of the shorter
constexpr double kApart = 0.5;                      // s between candidates
constexpr std::size_t kCandidates = 8;
constexpr int kMostSteps = 20;
constexpr double kClocks = 1e-4;  // standard deviation of a drift: crystals are within 20 to 100 ppm
constexpr double kBlock = 1.0;    // s over which what is missed is taken for related
// Evidence (nats) from which on it is no chance. Seven real flights of one vehicle laid over their own motion
// capture had 55 to 116, over that of each other and of another vehicle up to 16.
constexpr double kNoChance = 30.0;
constexpr double kOdds = 1e3;   // of the best offset against the next
constexpr double kGross = 3.0;  // times the median of what is missed: tracking that was lost counts less

RunningTurn turn_of(const FlightLog& log) {
  return log.has_rates() ? turn_of_gyro(log) : turn_of_attitudes(log);
}

// Sizes of the rates on an even grid about their mean, zero where not known, and where they are known.
struct Sizes {
  std::vector<double> x, known;
};
Sizes sizes_of(const RunningTurn& turn) {
  MeanRate rate(turn, kWide);
  const auto n = static_cast<std::size_t>((turn.t.back() - turn.t.front()) / kGrid) + 1;
  Sizes out{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double size = rate.at(turn.t.front() + static_cast<double>(i) * kGrid).norm();
    if (!std::isfinite(size)) continue;
    out.x[i] = size, out.known[i] = 1.0, sum += size, count += 1;
  }
  for (std::size_t i = 0; i < n; ++i) out.x[i] -= out.known[i] * sum / std::max(count, 1.0);
  return out;
}

// sum_i a(i + lag) b(i) for all lags; negative ones are at the end.
class Correlator {
 public:
  explicit Correlator(std::size_t length) : length_(std::bit_ceil(length)) {}

  std::vector<double> operator()(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<Complex> A = transform(a), B = transform(b);
    for (std::size_t k = 0; k < A.size(); ++k) A[k] *= std::conj(B[k]);
    std::vector<double> out(length_);
    fft_.inv(out, A);
    return out;
  }

 private:
  std::vector<Complex> transform(std::vector<double> x) {
    x.resize(length_, 0.0);
    std::vector<Complex> X;
    fft_.fwd(X, x);
    return X;
  }

  std::size_t length_;
  Eigen::FFT<double> fft_;
};

std::vector<double> squares(std::vector<double> x) {
  for (double& v : x) v *= v;
  return x;
}

// Offsets of the recording at which the sizes agree beyond chance most, apart from each other.
std::vector<double> candidates(const RunningTurn& log, const RunningTurn& recording) {
  const Sizes a = sizes_of(log), b = sizes_of(recording);
  Correlator correlate(a.x.size() + b.x.size());
  const std::vector<double> agree = correlate(a.x, b.x), of_a = correlate(squares(a.x), b.known),
                            of_b = correlate(a.known, squares(b.x)), both = correlate(a.known, b.known);
  const double shorter = static_cast<double>(std::min(a.x.size(), b.x.size())) * kGrid;
  const double least = std::min(kLeast, shorter / 2) / kGrid;
  // The correlation in its own standard deviations (Fisher), so that short overlaps do not win by chance.
  std::vector<std::pair<double, double>> found;  // how far beyond chance, offset
  const auto n = static_cast<long>(agree.size());
  for (long k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (both[i] < least || !(of_a[i] * of_b[i] > 0)) continue;
    const double r = std::clamp(agree[i] / std::sqrt(of_a[i] * of_b[i]), -0.9999, 0.9999);
    const long lag = k < static_cast<long>(a.x.size()) ? k : k - n;
    found.emplace_back(std::atanh(r) * std::sqrt(both[i]),
                       log.t.front() - recording.t.front() + static_cast<double>(lag) * kGrid);
  }
  std::ranges::sort(found, std::greater());
  std::vector<double> out;
  for (const auto& [beyond, offset] : found) {
    if (out.size() == kCandidates) break;
    if (std::ranges::all_of(out, [&](double other) { return std::abs(other - offset) > kApart; }))
      out.push_back(offset);
  }
  return out;
}

// What both show at the same instants, and how fast the log's rate changes there.
struct Pairs {
  std::vector<double> t;
  std::vector<Vector3d> log, change, recording;
};

class Refinement {
 public:
  Refinement(const RunningTurn& log, const RunningTurn& recording)
      : log_(log),
        recording_(recording),
        width_(std::max(kNarrow, 4 * std::max(recording.interval(), log.interval()))),
        grid_(std::max(kFineGrid, recording.interval())) {}

  MotionMatch from(double offset) const {
    MotionMatch match{.offset = offset,
                      .middle = std::clamp((log_.t.front() + log_.t.back()) / 2 - offset,
                                           recording_.t.front(), recording_.t.back())};
    for (int step = 0; step < kMostSteps; ++step)
      if (const double by = improve(match); by < 1e-7) break;
    return match;
  }

 private:
  Pairs pairs_at(const MotionMatch& match) const {
    Pairs out;
    MeanRate before(log_, width_), here(log_, width_), after(log_, width_), seen(recording_, width_);
    for (double t = recording_.t.front(); t <= recording_.t.back(); t += grid_) {
      const Vector3d u = seen.at(t), w = here.at(match.to_log(t));
      const Vector3d change =
          (after.at(match.to_log(t) + kFineGrid) - before.at(match.to_log(t) - kFineGrid)) / (2 * kFineGrid);
      if (!u.allFinite() || !w.allFinite() || !change.allFinite()) continue;
      out.t.push_back(t), out.log.push_back(w), out.change.push_back(change), out.recording.push_back(u);
    }
    return out;
  }

  static Matrix3d turn_between(const Pairs& pairs, const std::vector<double>& weight) {
    Matrix3d sum = Matrix3d::Zero();
    for (std::size_t i = 0; i < pairs.t.size(); ++i)
      sum += weight[i] * pairs.log[i] * pairs.recording[i].transpose();
    const Eigen::JacobiSVD<Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Matrix3d U = svd.matrixU(), V = svd.matrixV();
    const double sign = (U * V.transpose()).determinant() < 0 ? -1.0 : 1.0;
    return U * Vector3d(1, 1, sign).asDiagonal() * V.transpose();
  }

  // One step; returns by how much the offset moved, s. Gyro biases go with the means.
  double improve(MotionMatch& match) const {
    Pairs pairs = pairs_at(match);
    const std::size_t n = pairs.t.size();
    if (static_cast<double>(n) * grid_ < 2 * kWide) return 0.0;
    take_means(pairs.log), take_means(pairs.recording);
    std::vector<double> weight(n, 1.0);
    std::vector<Vector3d> missed(n);
    for (int round = 0; round < 2; ++round) {
      match.turn = turn_between(pairs, weight);
      std::vector<double> sizes;
      for (std::size_t i = 0; i < n; ++i) {
        missed[i] = pairs.log[i] - match.turn * pairs.recording[i];
        sizes.push_back(missed[i].norm());
      }
      const double far = kGross * median(sizes);
      for (std::size_t i = 0; i < n; ++i) weight[i] = sizes[i] > far && far > 0 ? far / sizes[i] : 1.0;
    }
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    Matrix3d about = Matrix3d::Zero();
    double square = 0, of_log = 0, missed_in_all = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::RowVector2d run(1.0, pairs.t[i] - match.middle);
      A += weight[i] * pairs.change[i].squaredNorm() * run.transpose() * run;
      b -= weight[i] * pairs.change[i].dot(missed[i]) * run.transpose();
      about += pairs.recording[i].squaredNorm() * Matrix3d::Identity() -
               pairs.recording[i] * pairs.recording[i].transpose();
      square += weight[i] * missed[i].squaredNorm();
      of_log += pairs.log[i].squaredNorm(), missed_in_all += weight[i] * missed[i].squaredNorm();
    }
    // Windows overlap: as many of them as fit beside each other are independent.
    const double each = square / (3.0 * static_cast<double>(n)) * width_ / grid_;
    A(1, 1) += std::max(each, 1e-12) / (kClocks * kClocks);
    b[1] -= std::max(each, 1e-12) / (kClocks * kClocks) * match.drift;
    const Eigen::Vector2d by = A.inverse() * b;
    if (!by.allFinite()) return 0.0;
    match.offset += by[0], match.drift += by[1];
    match.std = std::sqrt(each * A.inverse()(0, 0));
    match.turn_std = std::sqrt(each * about.inverse().diagonal().maxCoeff());
    match.alike = of_log > 0 ? 1 - missed_in_all / of_log : 0.0;
    return std::abs(by[0]);
  }

  static void take_means(std::vector<Vector3d>& x) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& v : x) sum += v;
    for (Vector3d& v : x) v -= sum / static_cast<double>(x.size());
  }

  const RunningTurn& log_;
  const RunningTurn& recording_;
  double width_, grid_;
};

// The log-likelihood by which the recording explains the log's rates better than nothing does, with the three
// axes of blocks of the overlap independent.
double evidence(const MotionMatch& match) {
  return -1.5 * match.seconds / kBlock * std::log(std::clamp(1 - match.alike, 1e-12, 1.0));
}

}  // namespace

MotionMatch match_motion(const FlightLog& log, const FlightLog& recording) {
  const RunningTurn of_log = turn_of(log), of_recording = turn_of_attitudes(recording);
  if (of_log.t.size() < 2)
    throw DataError(log.file + ": neither rates nor attitude were logged: nothing tells how " +
                    recording.file + " lies on it");
  if (of_recording.t.size() < 2) throw DataError(recording.file + ": it has no attitude");
  const Refinement refinement(of_log, of_recording);
  std::vector<MotionMatch> found;
  for (const double offset : candidates(of_log, of_recording)) found.push_back(refinement.from(offset));
  for (MotionMatch& match : found)
    match.seconds = std::min(of_log.t.back(), match.to_log(of_recording.t.back())) -
                    std::max(of_log.t.front(), match.to_log(of_recording.t.front()));
  std::ranges::sort(found, std::greater(), &evidence);
  if (found.empty() || !(evidence(found.front()) > kNoChance))
    throw DataError(fmt::format(
        "{} does not turn as {} does, however the two are laid over each other: at best {:.0f} % of the "
        "rates "
        "agree over {:.0f} s. Is it the same flight, and that vehicle? Both have to hold some turns.",
        recording.file, log.file, found.empty() ? 0.0 : 100 * std::max(found.front().alike, 0.0),
        found.empty() ? 0.0 : found.front().seconds));
  const MotionMatch& best = found.front();
  for (const MotionMatch& next : found)
    if (std::abs(next.offset - best.offset) > kApart && !(evidence(best) - evidence(next) > std::log(kOdds)))
      throw DataError(fmt::format(
          "{} lies on {} in several ways: with its times moved by {:.2f} s or by {:.2f} s. Give a recording "
          "that holds more than a motion that repeats itself, such as the takeoff.",
          recording.file, log.file, best.offset, next.offset));
  return best;
}

}  // namespace ident
