// `ident export`: a vehicle as a simulator's file, into the user's own one, or as samples.
#include <fmt/format.h>

#include "chosen_vehicle.h"
#include "ident/io/file/read_bytes.h"
#include "ident/io/simulators/patch.h"
#include "ident/io/simulators/samples.h"
#include "ident/io/simulators/simulators.h"

namespace ident::app {
namespace {

constexpr std::size_t kLargestFile = 16u << 20;

struct Options {
  std::string target, vehicle, params, output, into;
  std::size_t samples = 0;
  std::uint64_t seed = 1;
};

Outcome run(const Options& options, Context& context) {
  const SimulatorFormat& format = find_simulator(options.target);
  if (options.samples > 0 && !options.into.empty())
    throw UsageError("--samples writes a table, --into a single file: give one of them");
  const Vehicle vehicle = chosen_vehicle(options.vehicle, options.params, context);
  Result result;
  result.command = "export";
  result.inputs = {vehicle.file};
  result.extra["target"] = format.target;
  SimulatorExport made;
  std::string output = options.output;
  if (options.samples > 0) {
    made = export_to_simulator(format, vehicle);
    made.text = samples_csv(format, sampled_vehicles(vehicle, options.samples, options.seed), options.seed);
    result.seed = options.seed;
    result.extra["samples"] = options.samples;
  } else if (!options.into.empty()) {
    made = patch_simulator(format, read_bytes(options.into, kLargestFile), options.into, vehicle);
    made.text.insert(0, byte_order_mark(options.into));
    if (output.empty()) output = options.into;
  } else {
    made = export_to_simulator(format, vehicle);
  }
  for (const std::string& lost : made.lost) result.warn("left_out", std::string(format.target) + ": " + lost);
  context.notices.insert(context.notices.end(), made.notes.begin(), made.notes.end());
  result.extra["lost"] = made.lost;
  if (output.empty()) {
    result.extra["text"] = made.text;
    context.print = std::move(made.text);
    return result;
  }
  result.extra["output"] = output;
  context.outputs.add(output, std::move(made.text));
  result.verdict = options.samples > 0 ? fmt::format("{} sets of values for {} in {}, seed {}.",
                                                     options.samples, format.target, output, options.seed)
                                       : fmt::format("{} in {}.", format.meaning, output);
  return result;
}

}  // namespace

Action export_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  std::string targets;
  for (const SimulatorFormat& format : simulator_formats())
    targets += (targets.empty() ? "" : " ") + std::string(format.target);
  cli.add_option("TARGET", options->target, targets)->required();
  add_vehicle_options(cli, options->vehicle, options->params);
  cli.add_option("-o,--output", options->output, "file to write; none: on standard output")
      ->type_name("FILE");
  cli.add_option("--into", options->into, "your own file: only its values change; without -o it is replaced")
      ->type_name("FILE");
  cli.add_option("--samples", options->samples,
                 "a table of that many sets drawn from what is known, instead of a file")
      ->check(CLI::Range(1, 10000000));
  cli.add_option("--seed", options->seed, "of the samples")->capture_default_str();
  examples(cli,
           {{"ident export gz --vehicle falcon.yaml -o model.sdf", "a Gazebo model"},
            {"ident export gz --vehicle falcon.yaml --into model.sdf", "the same values in your own model"},
            {"ident export rotorpy --vehicle falcon.yaml --samples 1000 -o sets.csv",
             "for domain randomisation"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
