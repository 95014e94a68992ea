// Judges a log by what was sampled, at which rates, and how far the vehicle moved.
#include "ident/views/log_advice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace ident {
namespace {

constexpr double kSeldom = 49.0;  // Hz; below, motors' lag and inertia cannot be told (check seldom_commands)
// rad/s. A doublet of 10 deg in 0.2 s turns at 0.9 rad/s; one of them in 10 s makes a standard deviation of
// 0.13.
constexpr double kStill = 0.1;
constexpr double kSteadyThrust = 0.01;  // spread over mean, as in the self-test of a log

double median_rate(const std::vector<double>& t, std::span<const std::vector<double>> signal,
                   bool changes_only) {
  if (signal.empty() || signal.front().empty()) return 0.0;
  std::vector<double> steps;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const bool sampled =
        std::ranges::any_of(signal, [&](const std::vector<double>& c) { return std::isfinite(c[i]); });
    const bool news =
        !changes_only || !last ||
        std::ranges::any_of(signal, [&](const std::vector<double>& c) { return c[i] != c[*last]; });
    if (!sampled || !news) continue;
    if (last) steps.push_back(t[i] - t[*last]);
    last = i;
  }
  if (steps.empty()) return 0.0;
  std::ranges::nth_element(steps, steps.begin() + static_cast<long>(steps.size() / 2));
  return 1.0 / steps[steps.size() / 2];
}

bool is_used(const FlightLog& flight, double t) {
  return flight.windows.empty() || std::ranges::any_of(flight.windows, [&](const auto& window) {
           return t >= window[0] && t <= window[1];
         });
}

/// Mean and standard deviation of what was sampled within the windows.
std::array<double, 2> spread(const FlightLog& flight, const std::vector<double>& values) {
  double n = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || !is_used(flight, flight.t[i])) continue;
    n += 1, sum += values[i], squares += values[i] * values[i];
  }
  if (n < 2) return {0.0, 0.0};
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean))};
}

std::string px4_setting(const LogStreams& log) {
  const int profile = log.whole_parameter("SDLOG_PROFILE").value_or(1);
  if ((profile & 24) == 24) return "";  // motors come as often as they are told
  return fmt::format(
      "SDLOG_PROFILE {} (now {}): bit 3, system identification, and bit 4, high rate, log the motors' "
      "commands at full rate",
      profile | 8 | 16, profile);
}

std::string ardupilot_setting(const LogStreams& log) {
  constexpr int kFastAttitude = 1, kRawImu = 524288;  // bits of LOG_BITMASK
  const int mask = log.whole_parameter("LOG_BITMASK").value_or(176126);
  std::vector<std::string> bits;
  if ((mask & kFastAttitude) == 0)
    bits.emplace_back("bit 0, fast attitude, logs the rates' controller, from which commands are rebuilt");
  if ((mask & kRawImu) == 0) bits.emplace_back("bit 19, raw IMU, logs the sensors before their filters");
  if (bits.empty()) return "";
  return fmt::format("LOG_BITMASK {} (now {}): {}", mask | kFastAttitude | kRawImu, mask,
                     fmt::join(bits, "; "));
}

std::string faster_commands(const LogStreams& log) {
  if (log.format == "ulog") return px4_setting(log);
  if (log.format.starts_with("dataflash")) return ardupilot_setting(log);
  if (log.format.starts_with("blackbox"))
    return "blackbox_sample_rate, until main frames come at 1 kHz (1/4 of a loop of 4 kHz)";
  if (log.format == "crazyflie")
    return "in config.txt of the card: a frequency of 500, with motor.m1 to motor.m4";
  return "the logger's rate, until commands come at 100 Hz or more";
}

std::string rotor_speeds(const LogStreams& log) {
  if (log.format == "ulog")
    return "DSHOT_BIDIR_EN 1, where the speed controllers can: rotor speeds split the motors' lag from all "
           "the rest";
  if (log.format.starts_with("dataflash"))
    return "SERVO_BLH_BDMASK (bidirectional DShot), where the speed controllers can: rotor speeds split the "
           "motors' "
           "lag from all the rest";
  if (log.format == "blackbox")
    return "Betaflight 4.5 or later with dshot_bidir ON and the blackbox field RPM: rotor speeds split the "
           "motors' lag "
           "from all the rest";
  return "";
}

std::string choose_setting(const LogStreams& log, const SignalRates& rates) {
  if (rates.commands < kSeldom)
    if (std::string setting = faster_commands(log); !setting.empty()) return setting;
  if (log.format == "crazyflie") {
    if (rates.rates == 0) return "in config.txt of the card: gyro.x, gyro.y and gyro.z";
    if (rates.velocity == 0)
      return "in config.txt of the card: stateEstimate.vx, vy, vz and qw to qz; without velocity drag is not "
             "seen";
  }
  return rates.speeds == 0 ? rotor_speeds(log) : "";
}

std::string judge_motion(const Motion& motion) {
  std::vector<std::string> still;
  constexpr std::array kNames = {"roll", "pitch", "yaw"};
  for (std::size_t k = 0; k < 3; ++k)
    if (motion.rates[k] < kStill) still.emplace_back(kNames[k]);
  std::string text = fmt::format("rates vary by {:.2g}, {:.2g}, {:.2g} rad/s, thrust by {:.1f} %",
                                 motion.rates[0], motion.rates[1], motion.rates[2], 100 * motion.thrust);
  if (motion.fastest > 0) text += fmt::format(", speed up to {:.2g} m/s", motion.fastest);
  if (!still.empty())
    return text + fmt::format(": too little about {}: fly doublets there", fmt::join(still, ", "));
  if (motion.thrust < kSteadyThrust) return text + ": too little up and down: climb and sink";
  return text + ": enough";
}

}  // namespace

SignalRates signal_rates(const FlightLog& flight) {
  const auto rate = [&](std::span<const std::vector<double>> signal) {
    return median_rate(flight.t, signal, false);
  };
  return {
      .commands = median_rate(flight.t, flight.delta, true),
      .speeds = flight.Omega.empty() ? 0.0 : rate({flight.Omega.data(), 1}),  // each at instants of its own
      .rates = rate(flight.w_B),
      .specific_force = rate(flight.f_B),
      .attitude = rate(flight.q_WB),
      .velocity = rate(flight.v_W),
      .position = rate(flight.x_W),
      .battery = rate({&flight.vbat, 1})};
}

Motion motion_of(const FlightLog& flight) {
  Motion motion;
  for (std::size_t k = 0; k < 3; ++k) motion.rates[k] = spread(flight, flight.w_B[k])[1];
  const auto [mean, deviation] = spread(flight, flight.f_B[2]);
  if (mean != 0) motion.thrust = deviation / std::abs(mean);
  for (std::size_t i = 0; i < flight.v_W[0].size(); ++i) {
    const double speed = std::hypot(flight.v_W[0][i], flight.v_W[1][i], flight.v_W[2][i]);
    if (std::isfinite(speed) && is_used(flight, flight.t[i]))
      motion.fastest = std::max(motion.fastest, speed);
  }
  return motion;
}

LogAdvice advise(const LogStreams& log, const SignalRates& rates, const Motion& motion) {
  LogAdvice advice;
  const auto tell = [&](bool can, const char* what, const std::string& because) {
    if (can)
      advice.can.emplace_back(what);
    else
      advice.cannot.push_back(fmt::format("{} ({})", what, because));
  };
  const bool fast_commands = rates.commands >= kSeldom, speeds = rates.speeds > 0;
  const bool force = rates.specific_force > 0 || rates.velocity > 0;
  const std::string slow =
      rates.commands > 0 ? fmt::format("commands at {:.3g} Hz", rates.commands) : "no commands";
  tell(force, "thrust over commands, per mass", "neither specific force nor velocity");
  tell(fast_commands, "lag and dead time of the motors", slow);
  tell(rates.rates > 0 && (fast_commands || rates.speeds >= kSeldom), "inertia over thrust",
       rates.rates > 0 ? slow : "no rates");
  tell(speeds, "kT by itself, motors apart from the body", "no rotor speeds");
  tell(rates.velocity > 0 && rates.attitude > 0, "drag and wind",
       rates.velocity > 0 ? "no attitude" : "no velocity");
  tell(rates.battery > 0, "battery sag", "no voltage");
  advice.cannot.emplace_back("mass (weigh it)");
  advice.setting = choose_setting(log, rates);
  advice.movement = judge_motion(motion);
  return advice;
}

}  // namespace ident
