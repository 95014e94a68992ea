// `ident import`: a simulator's file as a vehicle file.
#include <fmt/format.h>

#include "command.h"
#include "ident/effects/all_parameters.h"
#include "ident/io/file/read_bytes.h"
#include "ident/io/simulators/simulators.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_write.h"

namespace ident::app {
namespace {

constexpr std::size_t kLargestFile = 16u << 20;

struct Options {
  std::string file, output;
};

Outcome run(const Options& options, Context& context) {
  const std::string text = read_bytes(options.file, kLargestFile);
  const SimulatorFormat* format = recognised_simulator(text);
  if (!format) {
    std::string known;
    for (const SimulatorFormat& one : simulator_formats())
      if (one.recognises) known += fmt::format("\n  {}", one.meaning);
    throw InputError(options.file, 0, "", "is no file of a simulator that is read; these are:" + known);
  }
  const Vehicle vehicle = vehicle_of_simulator(*format, text, options.file);
  const std::string yaml = vehicle_to_yaml(vehicle);
  Result result;
  result.command = "import";
  result.inputs = {options.file};
  result.warnings = vehicle.warnings;
  result.extra["format"] = format->target;
  result.extra["rotors"] = vehicle.rotors.size();
  for (const auto& [name, known] : vehicle.parameters) {
    Parameter p;
    p.name = name, p.value = known.value, p.unit = parameter_unit(name),
    p.source = std::string(format->target);
    result.parameters.push_back(p);
  }
  if (options.output.empty()) {
    context.print = yaml;
  } else {
    context.outputs.add(options.output, yaml);
    result.extra["output"] = options.output;
    result.verdict = fmt::format("{}: {} rotors, {} constants, in {}.", format->meaning,
                                 vehicle.rotors.size(), vehicle.parameters.size(), options.output);
  }
  return result;
}

}  // namespace

Action import_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  cli.add_option("FILE", options->file, "a simulator's file, known by its content")
      ->type_name("FILE")
      ->required();
  cli.add_option("-o,--output", options->output, "vehicle file to write; none: on standard output")
      ->type_name("FILE");
  examples(cli, {{"ident import model.sdf -o vehicle.yaml", "a Gazebo model as a vehicle file"},
                 {"ident import hummingbird_params.py", "RotorPy's parameters, on the screen"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
