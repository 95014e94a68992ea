// Flight logs made ready for estimation: uninterrupted arcs in flight, channels by number, noise levels to
// start from.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/flight/kernel/kernel.h"
#include "ident/flight/kernel/noise_model.h"

namespace ident {

/// The error that remains in smoothed rotor speeds, by mode and row.
struct SpeedErrors {
  std::vector<double> t;                      ///< s
  std::vector<std::vector<double>> variance;  ///< of the speed, (rad/s)^2
  std::vector<std::vector<double>> density;   ///< of the sensor noise, (rad/s)^2 s: variance by distance
  std::vector<std::vector<double>> other;     ///< difference of another smoothing to this one, rad/s
  Eigen::MatrixXd
      modes;  ///< [mode][rotor], orthogonal: errors of modes have nothing in common. Empty: rotors
};

/// An uninterrupted piece of one log.
struct FlightArc {
  int log = 0;
  std::vector<double> t;                            ///< s
  std::vector<double> y;                            ///< [row][kChannels], NaN where not sampled
  std::vector<double> q;                            ///< [row][4] measured attitude
  std::shared_ptr<const FlightInputs> inputs;       ///< of the whole log; pieces of an arc share them
  std::shared_ptr<const FlightInputs> rougher;      ///< where speeds are the input: the same, smoothed less
  std::shared_ptr<const SpeedErrors> speed_errors;  ///< where speeds are the input and have noise
  std::vector<BodyState<double>> body;              ///< [row] as read off the measurements
  bool stood = false;  ///< a motor may stand still at its start: rows with a motor off were left out before
  std::vector<MotorState<double>> motors;  ///< [row][rotor] measured, or simulated from the commands

  std::size_t rows() const { return t.size(); }
  std::size_t rotors() const { return motors.size() / rows(); }
  /// The state to start from at a row, without accelerations from outside.
  FlightState<double> start(std::size_t row) const;
  /// The rows [begin, end) as an arc of their own.
  FlightArc piece(std::size_t begin, std::size_t end) const;
};

/// Whether a channel group was logged at all.
struct Signals {
  bool commands = false, rates = false, force = false, attitude = false, velocity = false, position = false,
       rotor_speeds = false, voltage = false;
};

struct FlightRecord {
  const Vehicle* vehicle = nullptr;
  std::vector<FlightArc> arcs;
  int logs = 0;
  Signals signals;
  StateLayout layout;
  std::array<double, kChannels> sigma{};  ///< white noise level of each channel, from differences of the data
  SlowErrors slow{};                      ///< to start from; see slow_errors()
  double interval = 0.0;                  ///< median time between values of the densest sensor, s
  double duration = 0.0;                  ///< total of all arcs, s
  double motor_rate = 0.0;  ///< omega_m to start from, rad/s: the size that changes of rotor speed have
  double turns_apart =
      0.0;  ///< s that rates and attitude were apart in the logs: one of them was not in time
  std::vector<Warning> warnings;
  std::vector<double> p;  ///< the stated constants: states to start from are simulated with them, and what
                          ///< errors of speeds do is reckoned by them
};

/// Throws DataError where a path was logged, but neither rates nor attitude: a fit cannot find how the
/// vehicle turned.
void require_turning(const Signals& logged);

/// Share of each log to which a model is fitted; it is judged on the rest.
inline constexpr double kTrainingShare = 0.7;

/// Name of a channel: p, ax, attitude x, omega1.
std::string channel_name(int channel);

}  // namespace ident
