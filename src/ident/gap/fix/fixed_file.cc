// Patches a simulator's file, or writes YAML anew.
#include "ident/gap/fix/fixed_file.h"

#include "ident/effects/all_parameters.h"
#include "ident/gap/fix/refit.h"
#include "ident/io/file/read_bytes.h"
#include "ident/io/simulators/patch.h"
#include "ident/io/vehicle/vehicle_write.h"

namespace ident {
namespace {

constexpr std::size_t kLargestFile = 16u << 20;  // bytes

FixedFile fixed_yaml(const std::string& path, const Vehicle& stated, const Vehicle& identified) {
  FixedFile out{.text = vehicle_to_yaml(identified), .format = "vehicle"};
  out.notes.push_back(path + ": written anew: comments and layout of the file are not kept");
  for (const auto& [name, known] : identified.parameters) {
    const auto before = stated.parameters.find(name);
    if (before != stated.parameters.end() && before->second.value == known.value) continue;
    FileChange change{
        .name = name, .after = known.value, .std = known.std, .unit = parameter_unit(name), .of = name};
    if (before != stated.parameters.end()) change.before = before->second.value;
    out.changes.push_back(std::move(change));
  }
  return out;
}

}  // namespace

FixedFile fixed_file(const std::string& path, const Vehicle& stated, const Vehicle& identified,
                     std::span<const FlightLog> logs) {
  const std::string text = read_bytes(path, kLargestFile);
  const SimulatorFormat* format = recognised_simulator(text);
  if (!format) return fixed_yaml(path, stated, identified);
  SimulatorExport made = patch_simulator(*format, text, path, identified, &stated);
  if (!made.lost.empty())
    made.text = patch_simulator(*format, text, path, refitted(held_by(*format, identified), identified, logs),
                                &stated)
                    .text;
  FixedFile out{.format = std::string(format->target),
                .changes = file_changes(*format, text, made.text, path, identified),
                .lost = std::move(made.lost),
                .notes = std::move(made.notes)};
  out.text = byte_order_mark(path) + made.text;
  return out;
}

}  // namespace ident
