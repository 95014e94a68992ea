// Fits what RATE gives to the pulses that were logged, checks it, and puts both in order of time.
#include "ident/io/rebuild/ardupilot_commands.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ident/core/statistics.h"
#include "ident/io/rebuild/ardupilot_thrust.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of the range of pulses, of 19 of 20 samples: a pulse is a whole number of microseconds of about 900, and
// what was demanded may be a loop older. 7 us were seen on a flown log (ArduCopter 4.7), 5 us in the median
// on logs of 3.4 and 3.6.
constexpr double kAgrees = 0.01;
constexpr std::size_t kFewest = 20;   // samples of RCOU that no motor's limit touches
constexpr double kOften = 2.0;        // times as often as RCOU, for RATE to be worth it
constexpr double kTogether = 0.03;    // s between a pulse and the demand that made it, at most
constexpr double kClear = 0.01;       // of the range of pulses, from a limit
constexpr double kNone = 1e9;         // no disagreement: nothing to compare
constexpr double kLongestStep = 0.5;  // s between two pulses between which commands are rebuilt
constexpr double kPulse = 1e-3;       // of the range, about a microsecond
constexpr int kRounds = 8;
constexpr int kMostOutputs = 32, kFirstMotor = 33;  // SERVOn_FUNCTION of motor 1

double usual_step(const std::vector<double>& t) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i)
    if (t[i] > t[i - 1]) steps.push_back(t[i] - t[i - 1]);
  return steps.empty() ? 0 : median(std::move(steps));
}

std::optional<double> first_positive(const LogStreams& log, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const auto value = log.parameter(name); value && *value > 0) return value;
  return std::nullopt;
}

// Column of RCOU that drives a motor, from 1; nothing where no output does.
const StreamField* pulses_of(const LogStreams& log, const LogStream& rcou, int motor) {
  int output = motor;
  for (int k = 1; k <= kMostOutputs; ++k)
    if (log.parameter(fmt::format("SERVO{}_FUNCTION", k)) == kFirstMotor - 1 + motor) output = k;
  const StreamField* field = rcou.find(fmt::format("C{}", output));
  return field ? field : rcou.find(fmt::format("Ch{}", output));
}

class Rebuilder {
 public:
  Rebuilder(LogStreams& log, const LogStream& rcou, const LogStream& rate)
      : log_(log), rcou_(rcou), rate_(rate) {}

  void run() {
    if (!know_the_way() || !(usual_step(rcou_.t) > kOften * usual_step(rate_.t))) return;
    const double most = best_match();
    if (!(most < kNone)) return;
    const bool fits = most <= kAgrees;
    const std::string by =
        fmt::format("differ by {:.1e} of the range from {} samples of RCOU", most, matched_.size());
    log_.facts["commands"] =
        fits ? "commands rebuilt from RATE through the frame's mixer and MOT_THST_EXPO " + by
             : "motors as logged: commands rebuilt from RATE " + by + ", more than 0.01";
    if (fits) write();
  }

 private:
  struct Matched {
    std::size_t pulse, demand;
  };

  bool know_the_way() {
    const auto mix = ardupilot_mix(log_);
    const auto curve = ardupilot_curve(log_);
    const auto low = first_positive(log_, {"MOT_PWM_MIN", "RC3_MIN"}),
               high = first_positive(log_, {"MOT_PWM_MAX", "RC3_MAX"});
    if (!mix || !curve || !low || !high || !(*high > *low)) return false;
    mix_ = *mix, curve_ = *curve, low_ = *low, range_ = *high - *low;
    for (Index n = 0; n < mix_.rows(); ++n)
      pulses_.push_back(pulses_of(log_, rcou_, static_cast<int>(n) + 1));
    for (const char* name : {"ROut", "POut", "YOut", "AOut"}) demands_.push_back(rate_.find(name));
    const auto there = [](const StreamField* field) { return field != nullptr; };
    return std::ranges::all_of(pulses_, there) && std::ranges::all_of(demands_, there);
  }

  double command(std::size_t pulse, Index motor) const {
    return (pulses_[static_cast<std::size_t>(motor)]->at(pulse) - low_) / range_;
  }

  bool is_clear(std::size_t pulse) const {
    for (Index n = 0; n < mix_.rows(); ++n)
      if (const double u = command(pulse, n); !(u > curve_.spin_min + kClear && u < curve_.spin_max - kClear))
        return false;
    return true;
  }

  // Compensation of the battery at a time, as MOTB says: LiftMax and BatVolt. Off without MOT_BAT_VOLT_MAX.
  std::array<double, 2> battery(double t) const {
    const bool compensated = log_.parameter("MOT_BAT_VOLT_MAX").value_or(0) > 0;
    const LogStream* motb = compensated ? log_.find("MOTB") : nullptr;
    const StreamField *lift = motb ? motb->find("LiftMax") : nullptr,
                      *volts = motb ? motb->find("BatVolt") : nullptr;
    if (!lift || !volts || motb->t.empty()) return {1, 1};
    const auto after = std::ranges::upper_bound(motb->t, t);
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - motb->t.begin() - 1, 0));
    const double l = lift->at(i), v = volts->at(i);
    return {l > 0 ? l : 1, v > 0 ? v : 1};
  }

  // Releases differ in what they log first in a loop: the demand of a pulse is the last one before it, or
  // that before or after.
  double best_match() {
    double least = kNone;
    std::ptrdiff_t best = 0;
    for (const std::ptrdiff_t later : {0, 1, -1}) {
      const double off = disagreement_at(later);
      if (off < least) least = off, best = later;
    }
    if (!(least < kNone)) return kNone;
    disagreement_at(best);
    cut_pulses();
    return disagreement();
  }

  // A pulse is a whole number of microseconds: cut off [AP_MotorsMulticopter::output_to_pwm], rounded in
  // other releases. Which of them, if any, the pulses that were logged tell.
  void cut_pulses() {
    double least = kNone;
    std::optional<double> best;
    for (const std::optional<double> up : {std::optional<double>(), std::optional(0.0), std::optional(0.5)}) {
      up_ = up;
      const double off = mean_error();
      if (off < least) least = off, best = up;
    }
    up_ = best;
  }

  double disagreement_at(std::ptrdiff_t later) {
    match(later);
    if (matched_.size() < kFewest) return kNone;
    fit();
    return disagreement();
  }

  // Pulses that no limit touches with their demands.
  void match(std::ptrdiff_t later) {
    matched_.clear();
    for (std::size_t i = 0; i < rcou_.t.size(); ++i) {
      const auto after = std::ranges::upper_bound(rate_.t, rcou_.t[i]);
      const std::ptrdiff_t k = after - rate_.t.begin() - 1 + later;
      if (k < 0 || k >= std::ssize(rate_.t) || !is_clear(i)) continue;
      const auto demand = static_cast<std::size_t>(k);
      if (std::abs(rcou_.t[i] - rate_.t[demand]) < kTogether) matched_.push_back({i, demand});
    }
  }

  // Gains of roll, pitch, yaw and throttle, and what is added to the thrust of every motor.
  void fit() {
    const Index motors = mix_.rows();
    MatrixXd A(motors * static_cast<Index>(matched_.size()), 5);
    VectorXd b(A.rows());
    Index row = 0;
    for (const auto& [pulse, demand] : matched_) {
      const auto [lift, volts] = battery(rcou_.t[pulse]);
      for (Index n = 0; n < motors; ++n, ++row) {
        for (Index k = 0; k < 4; ++k)
          A(row, k) = mix_(n, k) * demands_[static_cast<std::size_t>(k)]->at(demand);
        A(row, 4) = 1;
        b[row] = curve_.thrust(command(pulse, n), lift, volts);
      }
    }
    gains_ = VectorXd::Zero(5);
    if (!A.allFinite() || !b.allFinite()) return;
    // Of least absolute deviations: where the mixer takes something back it is far off.
    VectorXd root = VectorXd::Ones(b.size());
    for (int round = 0; round < kRounds; ++round) {
      gains_ = (root.asDiagonal() * A).colPivHouseholderQr().solve(root.cwiseProduct(b));
      root = (A * gains_ - b).cwiseAbs().cwiseMax(kPulse).cwiseInverse().cwiseSqrt();
    }
  }

  // Commands that a demand makes; empty where a motor is at a limit.
  std::vector<double> made_by(std::size_t demand) const {
    const auto [lift, volts] = battery(rate_.t[demand]);
    std::vector<double> out;
    for (Index n = 0; n < mix_.rows(); ++n) {
      double thrust = gains_[4];
      for (Index k = 0; k < 4; ++k)
        thrust += gains_[k] * mix_(n, k) * demands_[static_cast<std::size_t>(k)]->at(demand);
      const double u = thrust > 0 ? curve_.command(thrust, lift, volts) : 0;
      if (!(u > curve_.spin_min + kClear && u < curve_.spin_max - kClear)) return {};
      out.push_back(up_ ? std::floor(u * range_ + *up_) / range_ : u);
    }
    return out;
  }

  // Of the motor that is farthest off, in order of size.
  std::vector<double> errors() const {
    std::vector<double> all;
    for (const auto& [pulse, demand] : matched_) {
      const std::vector<double> made = made_by(demand);
      double error = made.empty() ? 1.0 : 0.0;
      for (std::size_t n = 0; n < made.size(); ++n)
        error = std::max(error, std::abs(made[n] - command(pulse, static_cast<Index>(n))));
      all.push_back(error);
    }
    std::ranges::sort(all);
    return all;
  }

  double disagreement() const {
    const std::vector<double> all = errors();
    return all[all.size() * 19 / 20];
  }

  double mean_error() const {
    const std::vector<double> all = errors();
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  }

  // Pulses as logged, and between two that no limit touches what the demands make.
  void write() {
    std::map<double, std::vector<double>> rows;
    for (std::size_t i = 0; i + 1 < rcou_.t.size(); ++i) {
      if (!is_clear(i) || !is_clear(i + 1) || !(rcou_.t[i + 1] - rcou_.t[i] < kLongestStep)) continue;
      for (auto k = static_cast<std::size_t>(std::ranges::upper_bound(rate_.t, rcou_.t[i]) - rate_.t.begin());
           k < rate_.t.size() && rate_.t[k] < rcou_.t[i + 1]; ++k)
        if (std::vector<double> made = made_by(k); !made.empty()) rows[rate_.t[k]] = std::move(made);
    }
    for (std::size_t i = 0; i < rcou_.t.size(); ++i) {
      std::vector<double>& row = rows[rcou_.t[i]];
      row.clear();
      for (Index n = 0; n < mix_.rows(); ++n) row.push_back(std::clamp(command(i, n), 0.0, 1.0));
    }
    LogStream stream{.name = "motor_commands", .clock = "", .t = {}, .fields = {}};
    std::vector<std::vector<double>> columns(pulses_.size());
    for (const auto& [t, commands] : rows) {
      stream.t.push_back(t);
      for (std::size_t n = 0; n < commands.size(); ++n) columns[n].push_back(commands[n]);
    }
    for (std::size_t n = 0; n < columns.size(); ++n)
      stream.fields.push_back({fmt::format("motor[{}]", n), "", 1.0, std::move(columns[n])});
    log_.streams.push_back(std::move(stream));
  }

  LogStreams& log_;
  const LogStream rcou_, rate_;  ///< copies: adding a stream moves the others
  MatrixXd mix_;
  ArdupilotCurve curve_{};
  double low_ = 0, range_ = 1;
  std::optional<double> up_;  ///< us that are added to a pulse before it is cut to whole ones
  std::vector<const StreamField*> pulses_, demands_;
  std::vector<Matched> matched_;
  VectorXd gains_;
};

}  // namespace

void add_ardupilot_commands(LogStreams& log) {
  const LogStream *rcou = log.find("RCOU"), *rate = log.find("RATE");
  if (!log.format.starts_with("dataflash") || !rcou || !rate || log.find("motor_commands")) return;
  Rebuilder(log, *rcou, *rate).run();
}

}  // namespace ident
