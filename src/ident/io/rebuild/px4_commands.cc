// Rebuilds commands from setpoints and checks them against those that were logged.
#include "ident/io/rebuild/px4_commands.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "ident/io/rebuild/px4_allocation.h"

namespace ident {
namespace {

constexpr double kAgrees = 1e-3;     // of the command's range, of 19 of 20 samples
constexpr std::size_t kFewest = 5;   // samples at one instant, for a check to say anything
constexpr double kPublished = 1e-6;  // s per count of `timestamp`

using Thrusts = std::vector<double>;

/// Three numbers of a setpoint by the instant of the gyro sample that it answers, us.
std::map<double, std::array<double, 3>> by_instant(const LogStream& stream) {
  std::map<double, std::array<double, 3>> samples;
  const StreamField* instant = stream.find("timestamp_sample");
  const StreamField* xyz[] = {stream.find("xyz[0]"), stream.find("xyz[1]"), stream.find("xyz[2]")};
  if (!instant || !xyz[0] || !xyz[1] || !xyz[2]) return samples;
  for (std::size_t i = 0; i < instant->size(); ++i)
    samples[instant->at(i)] = {xyz[0]->at(i), xyz[1]->at(i), xyz[2]->at(i)};
  return samples;
}

class Rebuilder {
 public:
  Rebuilder(LogStreams& log, const LogStream& motors) : log_(log), motors_(motors) {
    const StreamField* field = nullptr;
    while ((field = motors_.find(fmt::format("control[{}]", controls_.size())))) controls_.push_back(field);
    while (!controls_.empty() && !ever_finite(*controls_.back())) controls_.pop_back();
    factor_ = log.parameter("THR_MDL_FAC").value_or(0.0);
  }

  void run() {
    if (controls_.empty()) return;
    rebuild();
    if (!rebuilt_.empty() && !agrees()) rebuilt_.clear();
    write();
  }

 private:
  static bool ever_finite(const StreamField& field) {
    for (std::size_t i = 0; i < field.size(); ++i)
      if (std::isfinite(field.at(i))) return true;
    return false;
  }

  /// Thrusts of the motors by the instant of the gyro sample; times of publication beside them.
  void rebuild() {
    const LogStream* torque = log_.find("vehicle_torque_setpoint:0");
    const LogStream* thrust = log_.find("vehicle_thrust_setpoint:0");
    const std::optional<Eigen::MatrixXd> mix = px4_mix(log_);
    if (!torque || !thrust || !mix || mix->rows() != static_cast<Eigen::Index>(controls_.size())) return;
    const auto thrusts = by_instant(*thrust);
    const StreamField* instant = torque->find("timestamp_sample");
    const StreamField* published = torque->find("timestamp");
    if (!instant || !published) return;
    for (const auto& [at, xyz] : by_instant(*torque)) {
      const auto force = thrusts.find(at);
      if (force == thrusts.end()) continue;
      Eigen::VectorXd wanted(6);
      wanted << xyz[0], xyz[1], xyz[2], force->second[0], force->second[1], force->second[2];
      const Eigen::VectorXd u = *mix * wanted;
      if (!u.allFinite() || u.minCoeff() <= 0 || u.maxCoeff() >= 1)
        continue;  // there PX4 takes something back
      rebuilt_[at] = Thrusts(u.begin(), u.end());
    }
    for (std::size_t i = 0; i < instant->size(); ++i)
      if (const auto at = rebuilt_.find(instant->at(i)); at != rebuilt_.end())
        time_[instant->at(i)] = torque->t[i] + (published->at(i) - instant->at(i)) * kPublished;
  }

  bool agrees() {
    const StreamField* instant = motors_.find("timestamp_sample");
    std::vector<double> errors;
    for (std::size_t i = 0; instant && i < instant->size(); ++i) {
      const auto at = rebuilt_.find(instant->at(i));
      if (at == rebuilt_.end()) continue;
      double error = 0;
      for (std::size_t k = 0; k < controls_.size(); ++k)
        error = std::max(error, std::abs(controls_[k]->at(i) - at->second[k]));
      errors.push_back(std::isfinite(error) ? error : std::numeric_limits<double>::infinity());
    }
    if (errors.size() < kFewest) {
      log_.facts["commands"] = fmt::format(
          "motors as logged: only {} samples of the setpoints fall on one of the motors, too few to check "
          "that "
          "commands can be rebuilt from them",
          errors.size());
      return false;
    }
    std::ranges::sort(errors);
    const double most = errors[errors.size() * 19 / 20];
    const bool fits = most <= kAgrees;
    const std::string by = fmt::format("differ by {:.1e} from {} samples of the motors", most, errors.size());
    log_.facts["commands"] =
        fits ? "commands rebuilt from torque and thrust setpoints through the allocation (CA_ROTOR*) " + by
             : "motors as logged: commands rebuilt from setpoints " + by + ", more than 1e-3";
    return fits;
  }

  /// Rows of (time, thrusts), logged ones and rebuilt ones in turn.
  void write() {
    std::map<double, Thrusts> rows;
    for (const auto& [instant, thrusts] : rebuilt_) rows[time_.at(instant)] = thrusts;
    const StreamField* published = motors_.find("timestamp");
    const StreamField* clock = motors_.find(motors_.clock);
    for (std::size_t i = 0; i < motors_.t.size(); ++i) {
      Thrusts row;
      for (const StreamField* control : controls_) {
        const double value = control->at(i);
        row.push_back(std::isfinite(value) ? value : 0.0);  // no number: the motor is stopped
      }
      const double late = published && clock ? (published->at(i) - clock->at(i)) * kPublished : 0.0;
      rows[motors_.t[i] + late] = std::move(row);
    }
    LogStream stream{.name = "motor_commands", .clock = "", .t = {}, .fields = {}};
    std::vector<std::vector<double>> columns(controls_.size());
    for (const auto& [t, thrusts] : rows) {
      stream.t.push_back(t);
      for (std::size_t k = 0; k < thrusts.size(); ++k) columns[k].push_back(px4_command(thrusts[k], factor_));
    }
    for (std::size_t k = 0; k < columns.size(); ++k)
      stream.fields.push_back({fmt::format("motor[{}]", k), "", 1.0, std::move(columns[k])});
    log_.streams.push_back(std::move(stream));
  }

  LogStreams& log_;
  const LogStream motors_;  ///< a copy: adding a stream moves the others
  std::vector<const StreamField*> controls_;
  double factor_ = 0.0;
  std::map<double, Thrusts> rebuilt_;
  std::map<double, double> time_;
};

}  // namespace

void add_px4_commands(LogStreams& log) {
  const LogStream* motors = log.find("actuator_motors:0");
  if (log.format != "ulog" || !motors || log.find("motor_commands")) return;
  Rebuilder(log, *motors).run();
}

}  // namespace ident
