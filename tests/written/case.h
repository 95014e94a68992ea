// One flight in the format of its autopilot and as CSV, with its vehicle file and the truth.
#pragma once

#include <string>

#include "flight.h"

namespace written {

// How a log is written; each writer reads what concerns it.
struct Logging {
  bool fast = false;             // PX4: system identification profile; ArduPilot: ATTITUDE_FAST and IMU_FAST
  bool rotor_speeds = false;     // ESC telemetry
  bool swapped_outputs = false;  // ArduPilot: motors 2, 3, 4 on the outputs 3, 4, 2
  bool old_firmware = false;     // Betaflight: 4.2, without gyroUnfilt, eRPM and motor_poles
};

void write_csv(const std::string& path, const Flight& flight, bool rotor_speeds);
void write_ulog(const std::string& path, const Flight& flight, const Logging& logging);
void write_dataflash(const std::string& path, const Flight& flight, const Logging& logging);
void write_blackbox(const std::string& path, const Flight& flight, const Logging& logging);
void write_card(const std::string& path, const Flight& flight);

// The vehicle file with constants that are off by up to one stated deviation, and the truth beside it.
void write_vehicle(const std::string& folder, const Vehicle& v, std::uint64_t seed);

}  // namespace written
