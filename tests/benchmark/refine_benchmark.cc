// Times reading, start, residuals, derivatives, solve and covariance of a refinement beside a plain Ceres
// version of the same problem, and the whole command: prints the table that README quotes.
//
//   refine_benchmark [RUNS]     least time of RUNS runs each, default 5
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "ident/core/simd/instruction_set.h"
#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/fit/fit_steps.h"
#include "ident/flight/make_record.h"
#include "ident/io/log/read_flight_log.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "plain_fit.h"

namespace ident {
namespace {

constexpr double kSegment = 1.0;  // s

constexpr const char* kVehicle = R"(name: benchmark
mass: {value: 0.5, std: 0.001}
layout: plus
arm: 0.17
parameters:
  kT: {value: 6.0e-6, std: 3.0e-7}
  kQ: {value: 1.0e-7, std: 1.0e-8}
  km: {value: 900, std: 40}
  omega_m: {value: 25, std: 2.5}
  zeta_m: {value: 0.9, std: 0.1}
  Jp: {value: 1.0e-5, std: 2.0e-6}
  Jxx: {value: 3.0e-3, std: 3.0e-4}
  Jyy: {value: 3.2e-3, std: 3.0e-4}
  Jzz: {value: 5.0e-3, std: 5.0e-4}
)";

double least_seconds(int runs, const std::function<void()>& work) {
  double least = 1e300;
  for (int i = 0; i < runs; ++i) {
    const auto began = std::chrono::steady_clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  }
  return least;
}

// Seconds and peak memory (MiB) of a command; -1 s when it fails.
std::pair<double, double> command(const std::vector<std::string>& words) {
  const auto began = std::chrono::steady_clock::now();
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) _exit(127);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0 ? seconds : -1.0,
          static_cast<double>(usage.ru_maxrss) / 1024.0};
}

// The same unknowns for both: constants and segment states, nothing from outside, no gyro bias.
struct Problem {
  Vehicle vehicle;
  FlightLog log;
  std::vector<double> p;
  FlightRecord record;
  std::unique_ptr<Theta> theta;

  Problem(const std::string& vehicle_file, const std::string& log_file)
      : vehicle(read_vehicle(vehicle_file)), log(read_flight_log(log_file, vehicle, {})) {
    p = parameter_vector(vehicle);
    start();
    theta = std::make_unique<Theta>(p, free_constants(vehicle, p), 1, false);
  }
  void start() {
    record = make_flight_record(vehicle, p, std::span(&log, 1));
    record.layout.w_dot = record.layout.v_dot = -1;
    record.layout.size = kPlainState;
  }
};

std::unique_ptr<FlightSmoother> segments(const Problem& problem, int threads) {
  const NoiseModel noise = initial_noise(problem.record);
  auto smoother = std::make_unique<FlightSmoother>(problem.record, *problem.theta, noise, kSegment, threads);
  smoother->unlink();
  smoother->set_huber(1e9);
  return smoother;
}

SharedMinimum fit_fast(const Problem& problem, int threads, double tolerance, bool exact = false) {
  const auto smoother = segments(problem, threads);
  smoother->set_exact(exact);
  return minimise_shared(*smoother, Eigen::VectorXd::Zero(problem.theta->size()), tolerance);
}

// All segments once, on one core, by an instruction set that this machine has; their states at `smoother`'s.
void evaluate_all(std::string_view isa, const Problem& problem, const FlightSmoother& smoother) {
  const FlightArc& arc = problem.record.arcs[0];
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.theta->size());
  const std::vector<Seed> seeds = problem.theta->seeds(zero, 0);
  std::array<double, kChannels> weight;
  for (std::size_t c = 0; c < kChannels; ++c) weight[c] = 1.0 / smoother.noise().sigma[c];
  ChunkTask task;
  task.vehicle = problem.record.vehicle, task.inputs = arc.inputs.get(), task.layout = problem.record.layout;
  task.p = problem.p, task.seeds = seeds, task.thetas = problem.theta->size(), task.rows = arc.rows();
  task.t = arc.t.data(), task.y = arc.y.data(), task.q = arc.q.data(), task.weight = weight.data();
  ChunkResult result;
  for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
    task.begin = smoother.chunks()[k].begin, task.end = smoother.chunks()[k].end;
    task.x0 = smoother.states()[k];
    evaluate_chunk_with(isa, task, result);
  }
}

void row(const std::string& what, double seconds, const std::string& note = "") {
  fmt::print("| {:<44} | {:>9.4f} | {} |\n", what, seconds, note);
}

int run(int runs) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("refine_benchmark_{}", getpid());
  std::filesystem::create_directories(folder);
  const std::string vehicle = folder / "vehicle.yaml", log = folder / "log.csv",
                    longer = folder / "longer.csv";
  std::ofstream(vehicle) << kVehicle;
  const auto fly = [&](const std::string& file, const std::string& seconds) {
    const auto [took, memory] =
        command({IDENT_PROGRAM, "simulate", "flight", "--vehicle", vehicle, "--duration", seconds, "--rate",
                 "250", "--seed", "5", "--without", "rotors", "--output", file});
    if (took < 0) throw std::runtime_error("ident simulate failed");
  };
  fly(log, "60"), fly(longer, "240");
  // Before anything is in memory here: a child's peak begins with its parent's size.
  const auto refine = [&](const std::string& file) {
    std::pair<double, double> best{1e300, 0};
    for (int i = 0; i < runs; ++i)
      best = std::min(
          best, command({IDENT_PROGRAM, "flightlog", file, "--vehicle", vehicle, "--refine", "--json"}));
    if (best.first < 0) throw std::runtime_error("ident flightlog failed");
    return best;
  };
  const auto [whole, memory] = refine(log);
  const auto [whole_long, memory_long] = refine(longer);
  Problem problem(vehicle, log);
  const Theta& theta = *problem.theta;
  if (theta.size() != kPlainShared) throw std::runtime_error("ten constants are expected");
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(theta.size());
  fmt::print("60 s, 250 Hz, 15 signals, {} constants, {} states in 1 s segments; kernel {}\n\n", kPlainShared,
             kPlainState * static_cast<int>(segments(problem, 1)->chunks().size()), best_isa());
  fmt::print("| step | seconds | |\n|---|---|---|\n");
  row("reading the log", least_seconds(runs, [&] { read_flight_log(log, problem.vehicle, {}); }));
  row("start", least_seconds(runs, [&] { problem.start(); }));
  const auto one = segments(problem, 1), two = segments(problem, 2);
  one->settle(zero, 1), two->settle(zero, 1);
  for (const char* isa : {"baseline", "avx2", "avx512"})
    if (runs_here(isa))
      row(fmt::format("residuals, derivatives, one core, {}", isa),
          least_seconds(runs, [&] { evaluate_all(isa, problem, *one); }));
  row("residuals, one core", least_seconds(runs, [&] { one->residuals(); }));
  const double linearise = least_seconds(runs, [&] { one->linearize(zero); });
  row("residuals, derivatives, elimination, one core", linearise);
  row("the same, two cores", least_seconds(runs, [&] { two->linearize(zero); }));
  row("elimination alone", least_seconds(runs, [&] { one->set_noise(one->noise()), one->relinearize(); }));
  // Plain Ceres stops on a relative change, minimise_shared on an absolute one.
  constexpr double tolerance = 1e-3;
  SharedMinimum fast;
  const double fast_one = least_seconds(runs, [&] { fast = fit_fast(problem, 1, tolerance); });
  row("fit, one core", fast_one, fmt::format("{} steps", fast.steps));
  const double fast_two = least_seconds(runs, [&] { fit_fast(problem, 2, tolerance); });
  row("fit, two cores", fast_two);
  PlainFit plain;
  const double relative = tolerance / fast.cost;
  const double plain_one = least_seconds(
      std::min(runs, 2), [&] { plain = fit_plainly(problem.record, theta, kSegment, relative, 1); });
  row("plain Ceres, one core", plain_one,
      fmt::format("{} steps, {:.3f} s derivatives, {:.3f} s linear algebra", plain.iterations,
                  plain.jacobian_seconds, plain.linear_seconds));
  const double plain_two =
      least_seconds(std::min(runs, 2), [&] { fit_plainly(problem.record, theta, kSegment, relative, 2); });
  row("plain Ceres, two cores", plain_two);
  Problem four_times(vehicle, longer);
  const double fast_long = least_seconds(runs, [&] { fit_fast(four_times, 2, tolerance); });
  row("fit of 240 s, two cores", fast_long);
  row("the whole command, noise and prediction too", whole, fmt::format("{:.0f} MiB", memory));
  row("the whole command on 240 s", whole_long, fmt::format("{:.0f} MiB", memory_long));
  std::filesystem::remove_all(folder);

  const Eigen::MatrixXd S = one->linearize(fast.u).S;
  fast = fit_fast(problem, 2, 1e-18, true);
  plain = fit_plainly(problem.record, theta, kSegment, 1e-18, 2);
  double apart = 0, in_std = 0;
  for (int i = 0; i < theta.size(); ++i) {
    apart = std::max(apart, std::abs(theta.physical(fast.u, i) / theta.physical(plain.u, i) - 1));
    in_std = std::max(in_std, std::abs(fast.u[i] - plain.u[i]) * std::sqrt(S(i, i)));
  }
  fmt::print("\nplain Ceres over the fit: {:.1f} on one core, {:.1f} on two; over the whole command {:.1f}; ",
             plain_one / fast_one, plain_one / fast_two, plain_one / whole);
  fmt::print("240 s over 60 s: {:.2f}\n", fast_long / fast_two);
  fmt::print("both fits: cost {:.9f} and {:.9f}, constants equal to {:.1e} ({:.1e} standard deviations)\n",
             fast.cost, plain.cost, apart, in_std);
  return 0;
}

}  // namespace
}  // namespace ident

int main(int argc, char** argv) { return ident::run(argc > 1 ? std::atoi(argv[1]) : 5); }
