// Reads both texts by the format and compares their entries.
#include "ident/io/simulators/changes.h"

#include <fmt/format.h>

#include <algorithm>

namespace ident {
namespace {

constexpr std::string_view kRotor = "rotor";

/// "timeConstantUp" of "rotor2.timeConstantUp"; nothing of an entry that is no rotor's.
std::string at_every_rotor(const std::string& name) {
  const std::size_t dot = name.find('.');
  return name.starts_with(kRotor) && dot != std::string::npos ? name.substr(dot + 1) : std::string();
}

bool is_alike(const FileChange& a, const FileChange& b) { return a.before == b.before && a.after == b.after; }

/// Changes of one entry at all rotors as one, where they are alike.
std::vector<FileChange> once_for_all_rotors(const std::vector<FileChange>& all, std::size_t rotors) {
  std::vector<FileChange> out;
  for (const FileChange& change : all) {
    const std::string name = at_every_rotor(change.name);
    const auto is_same_entry = [&](const FileChange& other) {
      return !name.empty() && at_every_rotor(other.name) == name && is_alike(other, change);
    };
    const bool everywhere =
        rotors > 1 && static_cast<std::size_t>(std::ranges::count_if(all, is_same_entry)) == rotors;
    if (everywhere && std::ranges::find(out, name, &FileChange::name) != out.end()) continue;
    out.push_back(change);
    if (everywhere) out.back().name = name;
  }
  return out;
}

}  // namespace

std::vector<FileChange> file_changes(const SimulatorFormat& format, const std::string& before,
                                     const std::string& after, const std::string& file,
                                     const Vehicle& vehicle) {
  const Fields old_fields = format.read(before, file), new_fields = format.read(after, file);
  const Values values = values_for(format, vehicle, &old_fields);
  std::vector<FileChange> out;
  for (std::size_t v = 0; v < values.all().size(); ++v) {
    const Value& value = values.all()[v];
    if (!new_fields.has(value.name)) continue;
    const std::vector<FieldNumber>& numbers = new_fields.at(value.name).numbers;
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      FileChange change{.after = numbers[n].value, .unit = value.unit, .of = value.of};
      change.name = numbers.size() == 1 ? value.name : fmt::format("{}[{}]", value.name, n);
      if (old_fields.has(value.name) && n < old_fields.at(value.name).numbers.size())
        change.before = old_fields.at(value.name).numbers[n].value;
      if (change.before == change.after) continue;
      // Deviations are of the first number of an entry.
      if (n == 0 && v < values.deviations.size() && values.deviations[v] > 0)
        change.std = values.deviations[v];
      out.push_back(std::move(change));
    }
  }
  return once_for_all_rotors(out, vehicle.rotors.size());
}

}  // namespace ident
