// Names of parameters in files against those inside: numbered rotors, and one radius that is squared inside.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ident/model/vehicle.h"

namespace ident {

/// Whether a parameter of that name may stand in a file (`effect.rotor` excepted, which names no quantity).
bool is_file_parameter(const std::string& name);

/// The names of the flight model's parameters in a file, for suggestions.
std::vector<std::string> file_parameter_names();

/// Whether an effect's parameters belong to one rotor, which the file names as `effect.rotor`.
bool names_a_rotor(std::string_view effect);

/// "rotor_drag" of "rotor_drag.kd"; empty for a base parameter.
std::string_view effect_of(std::string_view name);

/// One entry under `parameters` of a file; `word` instead of a number for `effect.rotor`.
struct FileParameter {
  std::string name;
  Known known;
  std::string word;
};

/// A file's parameter by its inside name; `rotor` 1..N, or 0 where none is named.
FileParameter to_inside(const FileParameter& stated, int rotor);

/// Name in a file of one parameter alone: a rotor that it carries stays with it.
std::string in_file(const std::string& inside_name);

/// All parameters in their file form. What is not finite is left out.
std::vector<FileParameter> to_file(const std::map<std::string, Known>& parameters);

}  // namespace ident
