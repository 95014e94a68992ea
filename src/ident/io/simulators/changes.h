// What a patch changes in a simulator's file, entry by entry in the format's own names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ident/io/simulators/simulators.h"

namespace ident {

/// One number of a file, before and after.
struct FileChange {
  std::string name;              ///< "timeConstantUp"; "rotor2.timeConstantUp" where the rotors differ
  std::optional<double> before;  ///< none: the file had no such entry
  double after = 0.0;
  std::optional<double> std;  ///< of `after`
  std::string unit;
  std::string of;  ///< constants of the vehicle that make it
};

/// Numbers that differ between two texts of a format, with the deviations that `vehicle` gives them. A change
/// that is the same for all rotors is listed once.
std::vector<FileChange> file_changes(const SimulatorFormat& format, const std::string& before,
                                     const std::string& after, const std::string& file,
                                     const Vehicle& vehicle);

}  // namespace ident
