// What a flight log shows of the truth: noise, bias, quantised commands, rates of each group of signals.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ident {

/// Standard deviations of white noise, except where said otherwise.
struct SensorNoise {
  double gyro = 0.0;           ///< rad/s
  double gyro_bias = 0.0;      ///< rad/s, drawn once a log (turn-on bias)
  double accelerometer = 0.0;  ///< m/s^2
  double attitude = 0.0;       ///< rad, about each axis
  double position = 0.0;       ///< m
  double velocity = 0.0;       ///< m/s
  double rotor_speed = 0.0;    ///< share of the hover speed
  double voltage = 0.0;        ///< share of the full voltage
  double pulse_us = 0.0;       ///< commands are multiples of this, us, where the vehicle has a command range
  double jitter = 0.0;         ///< share of the interval by which rows come early or late
};

/// `none`, `low` (a good laboratory), `typical`, `high`; throws UsageError for another name.
SensorNoise noise_level(std::string_view name);
std::span<const std::string> noise_levels();

/// Which groups of signals the log holds, and how often, in rows: 1 in each, 0 never.
struct LoggedSignals {
  int rates = 1, force = 1, attitude = 1, velocity = 1, position = 1, rotor_speeds = 1, battery = 1;
  bool commands = true;
};

}  // namespace ident
