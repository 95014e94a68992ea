// What a file is to a campaign, by its content and never by its name.
#pragma once

#include <string>
#include <vector>

namespace ident {

enum class FileKind {
  thrust,         ///< sweep of a propeller on a stand, or its published coefficients
  motor,          ///< steps of the command
  inertia,        ///< periods of a pendulum
  flight_log,     ///< CSV whose columns are known
  autopilot_log,  ///< any format of log_formats.def
  table,          ///< CSV with columns of other names, which a map may explain
  map,            ///< which column is which signal
  vehicle,        ///< vehicle file with rotors
  parameters,     ///< the same without rotors
  simulator,      ///< a vehicle in a simulator's file
  other,          ///< none of these, or one that cannot be read
};

struct FoundFile {
  std::string path;
  FileKind kind = FileKind::other;
  std::string what;  ///< what it is, in words; of others, why they are none of these
};

/// Reads the first bytes, a header, or a whole small text. Never throws for what the file holds.
FoundFile recognise_file(const std::string& path);

/// The files of a folder and its sub folders in the order of their names. What is hidden is passed over, and
/// so are sub folders with an `ident.yaml`: they are campaigns of their own. Throws InputError where there is
/// no such folder.
std::vector<std::string> files_of_folder(const std::string& folder);

/// What an error says of a file, without the file's name.
std::string without_name(const std::string& message, const std::string& path);

}  // namespace ident
