// Flies a plan with the true vehicle and keeps both the true motion and what the log shows of it.
#pragma once

#include <vector>

#include "battery.h"
#include "controller.h"
#include "drive.h"
#include "gusts.h"
#include "outside.h"
#include "sensors.h"

namespace withheld {

struct FlightSettings {
  PlanSettings plan;
  GustSettings gusts;
  double charge = 0.9;      // of the pack at the start
  double delay_margin = 0;  // s, dead time that the autopilot's gains allow for
};

// The truth at one row of the log.
struct Instant {
  double t;
  Motion motion, late;        // `late` is what delayed sensors see
  Acceleration acceleration;  // of the true vehicle
  Spin spin;
  Air air;
  double voltage;
};

struct Row {
  double t;
  Four delta, speed;
  Shown shown;  // with noise
  double voltage;
};

struct Flight {
  std::vector<Instant> truth;
  std::vector<Row> rows;
  Commands commands;
  std::vector<std::string> manoeuvres;
  double reference_voltage = 0;
  bool flown = true;  // false: lost control, hit the ground, or left the range of sound flight
  double farthest = 0, fastest = 0, steepest = 0, lowest = 0;  // m from the reference, m/s, rad, m
};

// `seed` and `index` fix plan, gusts and noise, so that a flight can be repeated with another size of effect.
Flight fly(const Vehicle& vehicle, const Effects& effects, const Instruments& instruments,
           const FlightSettings& settings, std::uint64_t seed, int index, double reference_voltage = 0);

}  // namespace withheld
