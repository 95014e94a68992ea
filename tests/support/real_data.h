// Where recordings lie that the project does not ship: IDENT_REAL_DATA, default ../shared/data beside the
// project.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <tuple>

#include "ident/model/vehicle.h"

namespace ident {

inline std::string real_data_folder() {
  const char* named = std::getenv("IDENT_REAL_DATA");
  return named ? named : std::string(IDENT_SOURCE_DIR) + "/../shared/data";
}

/// The rotors of the brushed Crazyflie of arplab_crazyflie, in the order of its motor columns; no constants.
inline Vehicle arplab_crazyflie() {
  Vehicle vehicle;
  for (const auto& [x, y, s] :
       {std::tuple{0.028, 0.028, 1}, {-0.028, 0.028, -1}, {-0.028, -0.028, 1}, {0.028, -0.028, -1}})
    vehicle.rotors.push_back({.r_B = {x, y, 0.0}, .s = s});
  return vehicle;
}

}  // namespace ident

/// Defines `folder`, or skips the test.
#define IDENT_NEEDS_REAL_DATA(folder)                   \
  const std::string folder = ident::real_data_folder(); \
  if (!std::filesystem::is_directory(folder))           \
  GTEST_SKIP() << "no recordings in " << folder << " (set IDENT_REAL_DATA)"
