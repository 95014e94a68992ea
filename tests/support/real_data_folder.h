// Where recordings lie that the project does not ship: IDENT_REAL_DATA, default ../shared/data beside the
// project.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace ident {

inline std::string real_data_folder() {
  const char* named = std::getenv("IDENT_REAL_DATA");
  return named ? named : std::string(IDENT_SOURCE_DIR) + "/../shared/data";
}

}  // namespace ident

/// Defines `folder`, or skips the test.
#define IDENT_NEEDS_REAL_DATA(folder)                   \
  const std::string folder = ident::real_data_folder(); \
  if (!std::filesystem::is_directory(folder))           \
  GTEST_SKIP() << "no recordings in " << folder << " (set IDENT_REAL_DATA)"
