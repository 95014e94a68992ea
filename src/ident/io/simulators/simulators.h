// Files of simulators: read as vehicles, written from vehicles, patched.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ident/io/simulators/simulator_format.h"

namespace ident {

/// All formats, in the order of simulators.def.
std::span<const SimulatorFormat> simulator_formats();

/// The format of a target's name; throws UsageError with the nearest name.
const SimulatorFormat& find_simulator(std::string_view target);

/// The format of a text by its content, or nullptr: a vehicle file, or no file of a simulator.
const SimulatorFormat* recognised_simulator(std::string_view text);

/// The vehicle of a simulator's file. Throws InputError. What was assumed is among its warnings.
Vehicle vehicle_of_simulator(const SimulatorFormat& format, const std::string& text, const std::string& file);

/// What an export gives.
struct SimulatorExport {
  std::string text;                ///< of the file
  Vehicle reduced;                 ///< what the file holds
  std::vector<std::string> lost;   ///< what it cannot hold
  std::vector<std::string> notes;  ///< what was decided, and entries that a patch could not place
};

/// The vehicle that a file of this format holds.
Vehicle held_by(const SimulatorFormat& format, const Vehicle& vehicle);

/// Entries of a file with their uncertainty, found by differences over all constants of the vehicle.
Values values_for(const SimulatorFormat& format, const Vehicle& vehicle, const Fields* own = nullptr);

/// A new file.
SimulatorExport export_to_simulator(const SimulatorFormat& format, const Vehicle& vehicle);

}  // namespace ident
