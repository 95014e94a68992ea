// Samples of autopilots' logs that the project does not ship, below IDENT_REAL_DATA/logs.
#pragma once

#include <filesystem>
#include <string>

#include "support/real_data_folder.h"

/// Defines `path` of a sample, or skips the test.
#define IDENT_NEEDS_LOG_SAMPLE(path, name)                                \
  const std::string path = ident::real_data_folder() + "/logs/" + (name); \
  if (!std::filesystem::is_regular_file(path))                            \
  GTEST_SKIP() << "no sample " << path << " (set IDENT_REAL_DATA)"
