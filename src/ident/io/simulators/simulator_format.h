// What a simulator's file format states about itself. One file in formats/ and one line in simulators.def
// each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ident/io/simulators/capacity.h"
#include "ident/io/simulators/fields.h"
#include "ident/io/simulators/value.h"
#include "ident/model/vehicle.h"

namespace ident {

struct SimulatorFormat {
  std::string_view target;   ///< word on the command line
  std::string_view meaning;  ///< one line for the help
  Capacity holds;
  /// Whether a text is a file of this format, by its content. Null: files of this format are not read.
  bool (*recognises)(std::string_view text) = nullptr;
  /// The entries of a file with their places.
  Fields (*read)(const std::string& text, const std::string& file) = nullptr;
  /// The vehicle that a file describes; assumptions are among its warnings.
  Vehicle (*vehicle)(const Fields& fields) = nullptr;
  /// Constants of the reduced vehicle that stand for what the file cannot hold, for example a linear drag.
  void (*stand_in)(const Vehicle& whole, Vehicle& reduced) = nullptr;
  /// The entries that hold a reduced vehicle; `own` is the user's file where one is patched, else null.
  std::vector<Value> (*values)(const Vehicle& reduced, const Fields* own) = nullptr;
  /// A whole new file.
  std::string (*page)(const Vehicle& reduced, const Values& values) = nullptr;
  /// What the format approximates, in the user's words.
  std::vector<std::string> (*remarks)(const Vehicle& whole, const Vehicle& reduced) = nullptr;
};

}  // namespace ident
