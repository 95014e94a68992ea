// Makes arcs of logs, numbers the channels, and reads first states and noise levels off the data.
#include "ident/flight/make_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/statistics.h"
#include "ident/flight/conditioning/battery_voltage.h"
#include "ident/flight/conditioning/estimator_drift.h"
#include "ident/flight/conditioning/smooth_voltage.h"
#include "ident/flight/conditioning/speed_modes.h"
#include "ident/flight/conditioning/velocity_bias.h"
#include "ident/flight/record/arcs.h"
#include "ident/flight/record/command_history.h"
#include "ident/flight/record/initial_states.h"

namespace ident {
namespace {

constexpr double kLongestDelay = 1.0;  ///< s of commands before a flight that may still act
constexpr double kStood = 0.1;         ///< s after rows with a motor off, in which it may not be up to speed
constexpr double kHistory = 0.05;  ///< s of known commands, beyond the stated dead time, before an arc starts

Signals signals_of(std::span<const FlightLog> logs) {
  Signals s;
  for (const FlightLog& log : logs) {
    s.commands |= log.has_commands();
    s.rates |= log.has_rates();
    s.force |= log.has_specific_force();
    s.attitude |= log.has_attitude();
    s.velocity |= log.has_velocity();
    s.position |= log.has_position();
    s.rotor_speeds |= log.has_rotor_speeds();
    s.voltage |= !log.vbat.empty();
  }
  return s;
}

StateLayout layout_of(const Signals& s, int rotors) {
  StateLayout layout;
  layout.rotors = rotors;
  int next = 3;
  const auto take = [&](int n) {
    const int at = next;
    next += n;
    return at;
  };
  if (s.attitude || s.velocity || s.position) layout.attitude = take(3);
  if (s.velocity || s.position) layout.v = take(3);
  if (s.position) layout.x = take(3);
  if (s.commands) layout.motors = take(2 * rotors);
  layout.w_dot = take(3);
  if (s.force || layout.v >= 0) layout.v_dot = take(3);
  layout.size = next;
  return layout;
}

FlightArc make_arc(const FlightLog& log, const std::vector<double>& voltage, int number, std::size_t begin,
                   std::size_t end, const Vehicle& vehicle, double v0, const Eigen::MatrixXd& modes) {
  FlightArc arc;
  arc.log = number;
  const auto cut = [&](const std::vector<double>& c) {
    return std::vector<double>(c.begin() + static_cast<std::ptrdiff_t>(begin),
                               c.begin() + static_cast<std::ptrdiff_t>(end));
  };
  arc.t = cut(log.t);
  const std::size_t rows = arc.rows();
  arc.y.assign(rows * kChannels, kNaN);
  arc.q.assign(rows * 4, kNaN);
  const auto put = [&](const std::vector<double>& column, int channel) {
    if (column.empty()) return;
    for (std::size_t i = 0; i < rows; ++i)
      arc.y[i * kChannels + static_cast<std::size_t>(channel)] = column[begin + i];
  };
  for (int k = 0; k < 3; ++k) {
    const auto c = static_cast<std::size_t>(k);
    put(log.w_B[c], kGyro + k), put(log.f_B[c], kForce + k), put(log.v_W[c], kVelocity + k),
        put(log.x_W[c], kPosition + k);
  }
  for (std::size_t i = 0; i < rows && log.has_attitude(); ++i) {
    bool whole = true;
    for (std::size_t k = 0; k < 4; ++k) whole &= std::isfinite(arc.q[4 * i + k] = log.q_WB[k][begin + i]);
    for (std::size_t k = 0; k < 3; ++k) arc.y[i * kChannels + kAttitude + k] = whole ? 0.0 : kNaN;
  }
  FlightInputs inputs;
  inputs.t0 = log.t.front();
  if (log.has_commands()) {
    inputs.delta = command_history(log, arc.t.front() - kLongestDelay, arc.t.back());
    inputs.jumps = command_jumps(log);
    for (std::size_t n = 0; n < log.Omega.size() && n < vehicle.rotors.size(); ++n)
      put(log.Omega[n], kRotorChannel + static_cast<int>(n));
  }
  inputs.t = arc.t;
  std::vector<std::vector<double>> speeds;
  for (const auto& column : log.Omega) speeds.push_back(cut(column));
  SmoothedSpeeds smoothed;
  if (log.has_commands()) {
    for (const auto& column : speeds) inputs.Omega.push_back(interpolated(arc.t, column));
  } else if (!speeds.empty()) {
    smoothed = smoothed_speeds(arc.t, speeds, modes);
    inputs.Omega = std::move(smoothed.likely);
  }
  if (!voltage.empty()) {
    inputs.voltage_ratio = interpolated(arc.t, cut(voltage));
    for (double& v : inputs.voltage_ratio) v = std::max(v / v0, 0.05);
  }
  if (!log.has_commands()) {
    FlightInputs other = inputs;
    other.Omega = std::move(smoothed.rougher);
    arc.rougher = std::make_shared<const FlightInputs>(std::move(other));
    if (!smoothed.errors.t.empty())
      arc.speed_errors = std::make_shared<const SpeedErrors>(std::move(smoothed.errors));
  }
  arc.inputs = std::make_shared<const FlightInputs>(std::move(inputs));
  return arc;
}

// Whether the input of every rotor is known, from commands or from speeds.
bool is_driven(const FlightArc& arc) {
  const auto& speeds = arc.inputs->Omega;
  return arc.inputs->commanded() ||
         (!speeds.empty() && std::ranges::none_of(speeds, [](const auto& s) { return s.empty(); }));
}

// Median time between values of the sensor that has most of them. Rows alone do not tell it: streams with
// times of their own make rows that may be microseconds apart.
double sensor_interval(const FlightRecord& record) {
  std::vector<double> most;
  for (const int channel : {kGyro, kForce, kAttitude, kVelocity, kPosition}) {
    std::vector<double> intervals;
    for (const FlightArc& arc : record.arcs) {
      double last = kNaN;
      for (std::size_t i = 0; i < arc.rows(); ++i) {
        if (!std::isfinite(arc.y[i * kChannels + static_cast<std::size_t>(channel)])) continue;
        if (std::isfinite(last)) intervals.push_back(arc.t[i] - last);
        last = arc.t[i];
      }
    }
    if (intervals.size() > most.size()) most = std::move(intervals);
  }
  return median(most);
}

// Throws where some logs have commands and others do not: motors are simulated for all logs or for none.
void require_like_inputs(std::span<const FlightLog> logs) {
  for (const FlightLog& log : logs)
    if (log.has_commands() != logs.front().has_commands())
      throw UsageError(
          fmt::format("{} has commands and {} has no usable ones: give them apart, or leave the command "
                      "columns out of all",
                      log.has_commands() ? log.file : logs.front().file,
                      log.has_commands() ? logs.front().file : log.file));
}

}  // namespace

FlightRecord make_flight_record(const Vehicle& vehicle, std::span<const double> p,
                                std::span<const FlightLog> logs, const RecordOptions& options) {
  FlightRecord record;
  record.vehicle = &vehicle;
  require_like_inputs(logs);
  record.logs = static_cast<int>(logs.size());
  record.signals = signals_of(logs);
  record.motor_rate = p[param::omega_m];
  record.p.assign(p.begin(), p.end());
  const int rotors = static_cast<int>(vehicle.rotors.size());
  if (rotors == 0 || rotors > kMaxRotors)
    throw UsageError(
        fmt::format("{}: rotors: 1 to {} rotors are supported, not {}", vehicle.file, kMaxRotors, rotors));
  record.layout = layout_of(record.signals, rotors);
  const Eigen::MatrixXd modes = speed_modes(vehicle, p);
  const double v0 = vehicle.battery_voltage.value_or(highest_voltage(logs));
  for (std::size_t n = 0; n < logs.size(); ++n) {
    const FlightLog& log = logs[n];
    if (log.rows() < 2) throw DataError(log.file + ": fewer than two rows");
    const double history = log.has_commands() ? kHistory + p[param::dead_time] : 0.0;
    const std::vector<double> voltage = quiet_voltage(log);
    for (const auto& [begin, end] : whole_pieces(log, history, options.longest_gap, record.warnings))
      if (FlightArc arc = make_arc(log, voltage, static_cast<int>(n), begin, end, vehicle, v0, modes);
          is_driven(arc)) {
        const double from = arc.t.front();
        arc.stood = std::ranges::any_of(
            log.left_out, [&](const auto& part) { return part[0] < from && part[1] > from - kStood; });
        record.arcs.push_back(std::move(arc));
      }
  }
  for (const FlightArc& arc : record.arcs) record.duration += arc.t.back() - arc.t.front();
  if (record.arcs.empty())
    throw DataError("no flight in these logs: no uninterrupted part of 0.3 s or more with turning rotors");
  if (!record.signals.rates && !record.signals.attitude && !record.signals.force &&
      !record.signals.velocity && !record.signals.position)
    throw DataError(
        "nothing that moves was logged: rates, attitude or specific force are needed, and a path helps");
  record.interval = sensor_interval(record);
  take_out_velocity_bias(record);
  set_noise_and_motor_start(record, p);
  set_body_start(record);
  add_slow_errors(record);
  return record;
}

}  // namespace ident
