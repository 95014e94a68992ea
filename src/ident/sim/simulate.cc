// The loop of a simulated flight: sensors, controller, excitation, plant.
#include "ident/sim/simulate.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/core/error.h"
#include "ident/core/random.h"
#include "ident/model/flight.h"
#include "ident/sim/recorder.h"
#include "ident/sim/scenario.h"
#include "ident/sim/turbulence.h"

namespace ident {
namespace {

constexpr double kBefore = 1.0;  // s of hover before the log starts

void check(const SimulationOptions& options) {
  if (!(options.duration > 0) || options.duration > 36000)
    throw UsageError("duration: between 0 and 36000 s, please");
  if (!(options.rate >= 20) || options.rate > 10000)
    throw UsageError("rate: between 20 and 10000 rows a second");
  if (!(options.longest_step >= 0)) throw UsageError("step: not below 0");
  if (!(options.turbulence >= 0)) throw UsageError("turbulence: not below 0");
  if (!(options.battery_used >= 0) || options.battery_used > 0.5)
    throw UsageError("battery: a share between 0 and 0.5");
}

/// Commands as the autopilot can give them.
void quantise(std::vector<double>& delta, const std::optional<CommandRange>& range, double pulse_us) {
  if (!range || !(pulse_us > 0)) return;
  const double span = range->max_us - range->min_us;
  for (double& d : delta) {
    const double pulse = std::round((range->min_us + d * span) / pulse_us) * pulse_us;
    d = std::clamp((pulse - range->min_us) / span, 0.0, 1.0);
  }
}

class FlightLoop {
 public:
  FlightLoop(const Vehicle& vehicle, const SimulationOptions& options)
      : options_(options),
        plant_(vehicle),
        trim_(hover_trim(plant_, Scenario::kHeight)),
        controller_(plant_, trim_, Scenario::kHeight, 1.0 / options.rate),
        scenario_(options.scenario, options.duration, plant_, trim_, controller_.agility(), options.rate,
                  options.seed),
        random_(options.seed),
        recorder_(plant_, options.noise, options.signals, trim_.Omega.front(), random_),
        air_(options.turbulence, plant_.constant(param::m), random_) {
    start();
  }

  SimulatedFlight fly() {
    const std::vector<double> times = row_times();
    const double delay = plant_.sensor_delay();
    // In the order of time: looks at the motion that a row will show `delay` later, and rows.
    for (std::size_t look = 0, row = 0; row < times.size();) {
      if (look < times.size() && times[look] - delay <= times[row]) {
        reach(times[look++] - delay);
        recorder_.look();
        continue;
      }
      reach(times[row]);
      write_row(row + 1 < times.size() ? times[row + 1] - times[row] : 1.0 / options_.rate);
      if (options_.progress && row % 256 == 0)
        options_.progress(static_cast<double>(row) / static_cast<double>(times.size()));
      ++row;
    }
    result_.log = recorder_.take();
    result_.gyro_bias = recorder_.gyro_bias();
    return std::move(result_);
  }

 private:
  void start() {
    const Setpoint to = scenario_.setpoint(0.0);
    const Vec3<double> rest = Vec3<double>::Zero();
    plant_.start(-kBefore, {trim_.q_WB, rest, rest, to.x_W}, trim_.Omega, trim_.delta);
    if (has_battery()) plant_.voltage(-kBefore, 1.0);
    result_.lowest = Scenario::kHeight;
  }

  bool has_battery() const { return plant_.vehicle().battery_voltage.has_value(); }

  std::vector<double> row_times() {
    const auto rows =
        static_cast<std::size_t>(std::floor(options_.duration * options_.rate * (1 + 1e-12))) + 1;
    std::vector<double> times;
    for (std::size_t i = 0; i < rows; ++i) {
      const double off = options_.noise.jitter * std::clamp(random_.normal(), -3.0, 3.0);
      const double early = i == 0 ? 0.0 : std::clamp(off, -0.3, 0.3);
      // Time stamps are whole microseconds, as loggers write them.
      const double t = (static_cast<double>(i) + early) / options_.rate;
      times.push_back(options_.noise.jitter > 0 ? std::round(t * 1e6) / 1e6 : t);
    }
    return times;
  }

  void reach(double t) {
    plant_.advance(t, options_.longest_step > 0 ? options_.longest_step : kEstimatorStep);
    const BodyState<double>& body = plant_.state().body;
    const double height = plant_.vehicle().ground_z - body.x_W[2];
    const double up = rotation(body.q_WB)(2, 2);
    if (!(height > 0.02) || !(up > -0.2) || !body.x_W.allFinite())
      throw DataError(
          fmt::format("the simulated vehicle crashes at {:.1f} s: it cannot fly this scenario", t));
    result_.lowest = std::min(result_.lowest, height);
  }

  void write_row(double interval) {
    const double t = plant_.t();
    const Setpoint to = scenario_.setpoint(t);
    recorder_.row(voltage_ratio_);
    FlightState<double> known = plant_.state();
    if (options_.by_gyro) known.body.w_B = recorder_.rates();
    std::vector<double> delta = controller_.command(known, to, interval);
    scenario_.excite(t, delta);
    quantise(delta, plant_.vehicle().command, options_.noise.pulse_us);
    recorder_.command(delta);
    result_.truth.push_back(plant_.state());
    result_.furthest = std::max(result_.furthest, (to.x_W - plant_.state().body.x_W).norm());
    plant_.command(t, delta);
    controller_.given(delta);
    if (has_battery()) discharge(t + interval);
    if (options_.turbulence > 0) {
      air_.step(interval);
      const Vec3<double> push_B = air_.F_B(), at_B(0.0, 0.0, -options_.gust_arm);
      plant_.disturb(push_B, air_.M_B() + cross(at_B, push_B));
    }
  }

  // The voltage falls with the charge that is used, and by 3 % a hover's worth of extra power.
  void discharge(double next) {
    double power = 0.0;
    for (std::size_t n = 0; n < trim_.Omega.size(); ++n) {
      const double speed = plant_.state().motors[n].Omega / trim_.Omega[n];
      power += speed * speed * speed / static_cast<double>(trim_.Omega.size());
    }
    voltage_ratio_ = 1.0 - options_.battery_used * next / options_.duration - 0.03 * (power - 1.0);
    plant_.voltage(next, voltage_ratio_);
  }

  SimulationOptions options_;
  Plant plant_;
  Trim trim_;
  Controller controller_;
  Scenario scenario_;
  Random random_;
  Recorder recorder_;
  Turbulence air_;
  double voltage_ratio_ = 1.0;
  SimulatedFlight result_;
};

}  // namespace

SimulatedFlight simulate_flight(const Vehicle& vehicle, const SimulationOptions& options) {
  check(options);
  return FlightLoop(vehicle, options).fly();
}

}  // namespace ident
