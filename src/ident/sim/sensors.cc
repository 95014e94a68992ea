// Levels of sensor noise by name.
#include "ident/sim/sensors.h"

#include <fmt/format.h>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"

namespace ident {

std::span<const std::string> noise_levels() {
  static const std::vector<std::string> names = {"none", "low", "typical", "high"};
  return names;
}

SensorNoise noise_level(std::string_view name) {
  // A small MEMS IMU on soft mounts, motion capture, speed by commutation.
  SensorNoise noise{.gyro = 0.01,
                    .gyro_bias = 0.005,
                    .accelerometer = 0.15,
                    .attitude = 0.004,
                    .position = 0.003,
                    .velocity = 0.02,
                    .rotor_speed = 0.003,
                    .voltage = 0.002,
                    .pulse_us = 1.0,
                    .jitter = 0.05};
  if (name == "typical") return noise;
  if (name == "none") return {};
  const bool low = name == "low";
  if (!low && name != "high")
    throw UsageError(
        fmt::format("unknown noise level '{}'{}", name,
                    did_you_mean(std::string(name), {noise_levels().begin(), noise_levels().end()})));
  for (double* size : {&noise.gyro, &noise.gyro_bias, &noise.accelerometer, &noise.attitude, &noise.position,
                       &noise.velocity, &noise.rotor_speed, &noise.voltage})
    *size *= low ? 0.25 : 4.0;
  return noise;
}

}  // namespace ident
