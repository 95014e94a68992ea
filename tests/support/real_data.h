// Vehicles of recordings that the project does not ship.
#pragma once

#include <string>
#include <tuple>

#include "ident/io/log/read_flight_log.h"
#include "ident/model/vehicle.h"
#include "support/real_data_folder.h"

namespace ident {

/// The rotors of the brushed Crazyflie of arplab_crazyflie, in the order of its motor columns; no constants.
inline Vehicle arplab_crazyflie() {
  Vehicle vehicle;
  for (const auto& [x, y, s] :
       {std::tuple{0.028, 0.028, 1}, {-0.028, 0.028, -1}, {-0.028, -0.028, 1}, {0.028, -0.028, -1}})
    vehicle.rotors.push_back({.r_B = {x, y, 0.0}, .s = s});
  return vehicle;
}

/// The same with what is known beforehand: a factor of 1.3 off and said to be so.
inline Vehicle arplab_crazyflie_known_vaguely() {
  Vehicle vehicle = arplab_crazyflie();
  const auto state = [&](const char* name, double value, double std) {
    vehicle.parameters[name] = {value, std};
  };
  state("m", 0.027, 3e-4), state("kT", 2e-8, 1e-8), state("kQ", 1.2e-10, 1.2e-10), state("km", 2400, 500);
  state("omega_m", 30, 30), state("zeta_m", 1, 0.5);
  state("Jxx", 1.4e-5, 7e-6), state("Jyy", 1.4e-5, 7e-6), state("Jzz", 2.2e-5, 1.1e-5);
  return vehicle;
}

/// A Crazyflie 2.1 of crazypad, with constants known as well as a stranger knows them.
inline Vehicle crazypad_crazyflie() {
  Vehicle vehicle;
  for (const auto& [x, y, s] :
       {std::tuple{0.0325, 0.0325, 1}, {-0.0325, 0.0325, -1}, {-0.0325, -0.0325, 1}, {0.0325, -0.0325, -1}})
    vehicle.rotors.push_back({.r_B = {x, y, 0.0}, .s = s});
  const auto state = [&](const char* name, double value, double std) {
    vehicle.parameters[name] = {value, std};
  };
  state("m", 0.0335, 1.5e-3), state("kT", 2.9e-8, 3e-9), state("kQ", 2e-10, 5e-11), state("km", 2400, 300);
  state("Omega_0", 300, 100), state("omega_m", 30, 5), state("zeta_m", 1, 0.2);
  state("Jxx", 1.6e-5, 2e-6), state("Jyy", 1.6e-5, 2e-6), state("Jzz", 2.9e-5, 4e-6);
  vehicle.battery_voltage = 4.2;
  return vehicle;
}

inline FlightLog crazypad_flight(const std::string& folder, const std::string& name, const Vehicle& vehicle) {
  return read_flight_log(folder + "/flight/crazypad/" + name + ".csv", vehicle,
                         read_log_map(std::string(IDENT_SOURCE_DIR) + "/data/maps/crazypad_crazyflie.yaml"));
}

}  // namespace ident
