// One simulated flight at 4 kHz: truth, raw and filtered sensors, set-points and commands.
#pragma once

#include <vector>

#include "autopilot.h"
#include "body.h"

namespace written {

struct Sample {  // at time index * kStep
  State truth;
  Vector3d gyro, accel;  // rad/s, m/s^2, FRD, unfiltered, with bias and noise
  Vector3d gyro_filtered, accel_filtered;
  Eigen::Quaterniond q_WB;  // what the estimator shows
  Vector3d p_W, v_W;
  SetPoints set;
  Outputs motors;  // hold from this sample to the next
  bool armed = false;
};

struct Noise {           // white, of one sample at 4 kHz or of one output of the estimator
  double gyro = 0.0087;  // rad/s: 0.011 deg/s/sqrt(Hz)
  double accel = 0.5;    // m/s^2: 0.011 m/s^2/sqrt(Hz)
  double angle = 0.0015, velocity = 0.01, position = 0.01;  // rad, m/s, m
  double gyro_bias = 0.004;                                 // rad/s, turn-on
};

// When the firmware notices touch-down, s after it: contact, perhaps landed, landed.
constexpr double kContact = 0.35, kMaybeLanded = 0.6, kLanded = 0.9;

struct Flight {
  Vehicle v;
  std::vector<Sample> samples;
  double take_off = 0, landing = 0;  // s
  double voltage(double t) const { return full_voltage - 0.004 * full_voltage / 10 * t; }
  double full_voltage = 16.0;
};

Flight fly(const Vehicle& v, std::uint64_t seed);

}  // namespace written
