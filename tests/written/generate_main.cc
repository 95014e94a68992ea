// Writes the flights: each in its autopilot's format, as CSV with and without rotor speeds, with vehicle file
// and truth.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "case.h"

using namespace written;

namespace {

struct Entry {
  const char* name;
  Stack stack;
  const char* file;
  Logging logging;
  double thrust_model = 0;
};

const Entry kFlights[] = {
    {"px4_default", Stack::px4, "log.ulg", {}},
    {"px4_thrust_model", Stack::px4, "log.ulg", {}, 0.35},
    {"px4_fast", Stack::px4, "log.ulg", {.fast = true, .rotor_speeds = true}},
    {"px4_fast_model", Stack::px4, "log.ulg", {.fast = true}, 0.35},
    {"ardupilot_default", Stack::ardupilot, "log.bin", {}},
    {"ardupilot_fast", Stack::ardupilot, "log.bin", {.fast = true, .rotor_speeds = true}},
    {"ardupilot_swapped",
     Stack::ardupilot,
     "log.bin",
     {.fast = true, .rotor_speeds = true, .swapped_outputs = true}},
    {"betaflight_4_5", Stack::betaflight, "log.bbl", {.rotor_speeds = true}},
    {"betaflight_4_2", Stack::betaflight, "log.bbl", {.old_firmware = true}},
    {"crazyflie", Stack::crazyflie, "log.usd", {}},
};

void write_log(const std::string& path, const Flight& flight, const Logging& logging) {
  switch (flight.v.stack) {
    case Stack::px4:
      return write_ulog(path, flight, logging);
    case Stack::ardupilot:
      return write_dataflash(path, flight, logging);
    case Stack::betaflight:
      return write_blackbox(path, flight, logging);
    case Stack::crazyflie:
      return write_card(path, flight);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: written_generate DIR [SEED]\n", stderr);
    return 2;
  }
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  std::uint64_t index = 0;
  for (const Entry& entry : kFlights) {
    const std::uint64_t own = seed * 1000 + index++;
    Vehicle v = make_vehicle(entry.stack, entry.name, own);
    v.thrust_model = entry.thrust_model;
    v.accel_biquad = entry.stack != Stack::betaflight || entry.logging.old_firmware;
    const Flight flight = fly(v, own);
    const std::string folder = std::string(argv[1]) + "/" + entry.name;
    std::filesystem::create_directories(folder);
    write_vehicle(folder, v, own);
    write_log(folder + "/" + entry.file, flight, entry.logging);
    write_csv(folder + "/full.csv", flight, true);
    write_csv(folder + "/commands.csv", flight, false);
    std::printf("%s: %.1f s, in the air from %.2f to %.2f s\n", entry.name,
                static_cast<double>(flight.samples.size()) * kStep, flight.take_off, flight.landing);
  }
}
