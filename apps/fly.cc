// `ident fly`: the vehicle served to an autopilot in the loop.
#include <fmt/format.h>

#include <csignal>

#include "chosen_vehicle.h"
#include "ident/core/nearest_word.h"
#include "ident/fly/autopilots.h"
#include "ident/fly/serve.h"
#include "ident/io/csv/write_csv.h"

namespace ident::app {
namespace {

struct Options {
  std::string autopilot, vehicle, params, build, log;
  std::vector<int> order;
  std::optional<std::uint16_t> port, state_port;
  std::optional<double> rate;
  ServeOptions serve;
};

volatile std::sig_atomic_t interrupted = 0;

/// Ctrl-C and `kill` end the flight, not the program, for as long as this lives.
class Interrupts {
 public:
  Interrupts() {
    struct sigaction act {};
    act.sa_handler = [](int) { interrupted = 1; };
    sigaction(SIGINT, &act, &before_int_);
    sigaction(SIGTERM, &act, &before_term_);
  }
  ~Interrupts() {
    sigaction(SIGINT, &before_int_, nullptr);
    sigaction(SIGTERM, &before_term_, nullptr);
  }
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

 private:
  struct sigaction before_int_ {
  }, before_term_{};
};

std::string build_of(const AutopilotInfo& info, const std::string& wanted) {
  if (wanted.empty()) return info.builds.empty() ? "" : info.builds.front();
  if (std::ranges::find(info.builds, wanted) != info.builds.end()) return wanted;
  throw UsageError(info.builds.empty()
                       ? fmt::format("--build: {} has one only", info.name)
                       : fmt::format("--build: {} has {}{}", info.name, fmt::join(info.builds, ", "),
                                     did_you_mean(wanted, info.builds)));
}

ServeOptions serve_options(const Options& options, const AutopilotInfo& info) {
  if (info.rate == 0 && (options.rate || options.state_port))
    throw UsageError(
        fmt::format("{} sets the pace itself and is answered where it sends from: no --rate, no "
                    "--state-port",
                    info.name));
  ServeOptions serve = options.serve;
  serve.port = options.port.value_or(info.port);
  serve.state_port = options.state_port.value_or(info.state_port);
  serve.rate = options.rate.value_or(info.rate);
  serve.record = !options.log.empty();
  serve.stop = [] { return interrupted != 0; };
  return serve;
}

Result description(const AutopilotInfo& info, const Vehicle& vehicle, const Served& served) {
  Result result;
  result.command = "fly";
  result.inputs = {vehicle.file};
  std::size_t refused = 0;
  std::string kinds;
  for (const auto& [wrong, count] : served.refused) {
    refused += count;
    kinds += fmt::format("{}{} x {}", kinds.empty() ? "" : "; ", count, wrong);
  }
  Vec3<double> moved = served.last.x_W - served.last.start_W;
  for (int i = 0; i < 3; ++i) moved[i] = std::round(1e2 * moved[i]) / 1e2 + 0.0;  // cm, no -0
  result.extra["autopilot"] = info.name;
  result.extra["seconds"] = served.seconds;
  result.extra["frames"] = served.frames;
  result.extra["repeated"] = served.repeated;
  result.extra["restarts"] = served.restarts;
  result.extra["lost"] = served.lost;
  result.extra["refused"] = served.refused;
  result.extra["late"] = served.late;
  result.extra["ended_at"] = {moved[0], moved[1], moved[2]};
  result.verdict =
      served.frames == 0
          ? fmt::format("No command of {} arrived.", info.name)
          : fmt::format(
                "{:.2f} s flown with {} in {} frames; it ended {:.2f} m north, {:.2f} m east, {:.2f} m up.",
                served.seconds, info.name, served.frames, moved[0], moved[1], 0.0 - moved[2]);
  if (refused > 0)
    result.warn("datagrams_refused", fmt::format("{} datagrams are no commands: {}", refused, kinds));
  if (served.lost > 0)
    result.warn("frames_lost", fmt::format("{} frames of {} never arrived", served.lost, info.name));
  if (served.late > 0)
    result.warn("behind_the_clock",
                fmt::format("the simulation fell {:.2f} s behind the clock", served.late));
  return result;
}

void announce(const AutopilotInfo& info, const ServeOptions& serve, std::uint16_t port,
              const MotorOrder& order) {
  fmt::print(stderr, "{}\n", order.note);
  fmt::print(
      stderr, "listening on {}:{}{}; start the autopilot: {}\nCtrl-C ends\n", serve.address, port,
      serve.rate > 0 ? fmt::format(", readings go to port {} at {:g} Hz", serve.state_port, serve.rate) : "",
      info.start);
  std::fflush(stderr);
}

Outcome run(const Options& options, Context& context) {
  const AutopilotInfo& info = find_autopilot(options.autopilot);
  const std::unique_ptr<Autopilot> autopilot = info.make(build_of(info, options.build));
  const Vehicle vehicle = chosen_vehicle(options.vehicle, options.params, context);
  const MotorOrder order =
      options.order.empty() ? autopilot->order(vehicle) : given_order(vehicle, options.order);
  ServeOptions serve = serve_options(options, info);
  serve.rotor_of_output = order.rotor_of_output;
  Progress progress("flying");
  if (std::isfinite(serve.seconds))
    serve.progress = [&](const Readings& r) { progress.update(r.t / serve.seconds); };
  Server server(*autopilot, vehicle, serve);
  announce(info, serve, server.port(), order);
  const Interrupts ends_the_flight;
  Served served = server.run();
  Result result = description(info, vehicle, served);
  result.extra["order"] = order.note;
  if (!options.log.empty() && served.log.rows() > 0) {
    context.outputs.add(options.log,
                        flight_log_to_csv(served.log, vehicle, CsvDigits::full,
                                          {fmt::format("ident fly {} of {}", info.name, vehicle.file)}));
    result.extra["log"] = options.log;
    result.verdict += fmt::format(" {} rows{} in {}.", served.log.rows(),
                                  served.restarts > 0 ? " of the last start" : "", options.log);
  }
  return {std::move(result), served.frames > 0 ? ExitStatus::done : ExitStatus::data_do_not_allow};
}

std::string list_of_autopilots() {
  std::string text = "Autopilots:";
  for (const AutopilotInfo& info : autopilots()) text += fmt::format("\n  {:<12}{}", info.name, info.meaning);
  return text;
}

}  // namespace

Action fly_command(CLI::App& cli) {
  auto o = std::make_shared<Options>();
  cli.add_option("AUTOPILOT", o->autopilot, "one of the autopilots above")->required();
  add_vehicle_options(cli, o->vehicle, o->params);
  cli.add_option("--port", o->port, "where commands arrive; 9002 if not given, 0 for a free one");
  cli.add_option("--state-port", o->state_port, "betaflight: where readings go; 9003 if not given");
  cli.add_option("--address", o->serve.address, "of this machine, where the port is opened")
      ->capture_default_str();
  cli.add_option("--rate", o->rate, "betaflight: readings a second against the clock; 1000 if not given")
      ->check(CLI::Range(50.0, 20000.0));
  cli.add_option("--build", o->build,
                 "betaflight: how its SITL was built. released: 4.x, 2025.12; bridge: 2026 with "
                 "ENABLE_GAZEBO_BRIDGE=0; gazebo: 2026 by default");
  cli.add_option("--order", o->order,
                 "rotor that each output of the autopilot drives, in turn; none: by place and spin")
      ->delimiter(',')
      ->type_name("N,N,..");
  cli.add_option("--legs", o->serve.legs,
                 "height of the origin above the ground where the vehicle stands, m; none: half the arm")
      ->check(positive_number());
  cli.add_option("--seconds", o->serve.seconds, "end after that much simulated time; none: by Ctrl-C")
      ->check(positive_number());
  cli.add_option("--log", o->log, "write what was flown as a flight log, CSV")->type_name("FILE");
  examples(cli, {{"ident fly ardupilot --vehicle falcon.yaml",
                  "then: sim_vehicle.py -v ArduCopter --model JSON:127.0.0.1"},
                 {"ident fly betaflight --vehicle falcon.yaml --log flown.csv", "then: betaflight_SITL.elf"},
                 {"ident fly ardupilot --vehicle falcon.yaml --order 3,1,4,2 --seconds 60",
                  "output 1 drives rotor 3, output 2 rotor 1"}});
  cli.footer(cli.get_footer() + "\n\n" + list_of_autopilots());
  return [o](Context& context) { return run(*o, context); };
}

}  // namespace ident::app
