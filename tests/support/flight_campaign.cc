// Draws vehicles, flies them, refines them, and computes what no unbiased estimate can beat.
#include "support/flight_campaign.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "ident/core/error.h"
#include "ident/core/random.h"
#include "ident/flight/make_record.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "support/random_vehicle.h"
#include "support/ring_of_rotors.h"
#include "support/shaken.h"
#include "support/slow_errors.h"

namespace ident::flight_campaign {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPush = 0.3, kTurn = 0.006, kGustTime = 1.5;  // as in model/turbulence.h: 1/s, m/s, s

/// The next vehicle at or after this seed that has one of the three layouts.
Vehicle drawn_vehicle(std::uint64_t seed) {
  for (std::uint64_t k = 1000 * seed;; ++k)
    if (Vehicle v = random_vehicle(k); !v.layout.empty()) return v;
}

/// The same vehicle with six or eight rotors, which share its thrust.
Vehicle with_many_rotors(Vehicle v, std::uint64_t seed) {
  const int rotors = seed % 2 == 0 ? 6 : 8;
  for (const char* name : {"kT", "kQ", "Jp"}) v.parameters.at(name).value *= 4.0 / rotors;
  v.rotors = testing::ring(rotors, v.arm.value());
  v.layout.clear(), v.parameters.erase("alpha");
  return v;
}

/// What a bench says: a standard deviation of 5 to 20 % of the truth, and a value drawn with it. Every other
/// vehicle was weighed to 0.2 %, the others exactly.
Vehicle measured(const Vehicle& truth, Random& random) {
  Vehicle v = truth;
  for (auto& [name, known] : v.parameters) {
    if (name == "alpha" || known.value == 0) continue;
    if (name == "m" && random.below(2) == 0) continue;
    const double share = name == "m" ? 0.002 : random.uniform(0.05, 0.20);
    const double std = share * known.value;
    // A bench gives no negative constant: beyond three standard deviations it would have been repeated.
    known = {known.value + std * std::clamp(random.normal(), -3.0, 3.0), std};
  }
  return v;
}

double hover_speed(const Vehicle& v) {
  return std::sqrt(v.value("m") * v.g / (static_cast<double>(v.rotors.size()) * v.value("kT")));
}

/// RMS of the accelerations (without gravity and lift) and of the angular ones, from state to state.
struct Motion {
  double push = 0.0, turn = 0.0;
};
Motion motion_of(const std::vector<SimulatedFlight>& flights) {
  Motion sum;
  double count = 0;
  constexpr std::size_t step = 5;
  for (const SimulatedFlight& f : flights)
    for (std::size_t i = step; i < f.truth.size(); i += step) {
      const double h = f.log.t[i] - f.log.t[i - step];
      const BodyState<double>&a = f.truth[i - step].body, &b = f.truth[i].body;
      sum.push += ((b.v_W - a.v_W) / h).squaredNorm() / 3;
      sum.turn += ((b.w_B - a.w_B) / h).squaredNorm() / 3;
      count += 1;
    }
  return {std::sqrt(sum.push / count), std::sqrt(sum.turn / count)};
}

SimulatedFlight flown(const Vehicle& v, SimulationOptions options, std::string& scenario) {
  try {
    options.scenario = scenario;
    return simulate_flight(v, options);
  } catch (const DataError&) {  // too slow a vehicle for that one
    scenario = options.scenario = "mixed";
    return simulate_flight(v, options);
  }
}

/// Rotors are not all alike, from half of that amplitude to one and a half.
void shake(const Case& c, SimulatedFlight& flight) {
  const std::size_t rotors = c.truth.rotors.size();
  const SensorNoise sensor = noise_level("typical");
  std::vector<std::vector<double>> Omega(rotors, std::vector<double>(flight.log.rows()));
  std::vector<double> amplitude;
  for (std::size_t n = 0; n < rotors; ++n) {
    for (std::size_t i = 0; i < flight.log.rows(); ++i) Omega[n][i] = flight.truth[i].motors[n].Omega;
    const double share = static_cast<double>(n) / static_cast<double>(rotors - 1);
    amplitude.push_back((0.5 + share) * c.shaken * sensor.accelerometer);
  }
  testing::shake(flight.log, Omega, hover_speed(c.truth), amplitude, sensor.gyro / sensor.accelerometer);
}

void fly(Case& c, double seconds, bool commands) {
  SimulationOptions options;
  options.duration = seconds;
  options.turbulence = c.gusts;
  options.by_gyro = c.by_gyro;
  options.signals.rotor_speeds = c.rotor_speeds ? 1 : 0;
  c.flights.clear();
  for (std::size_t i = 0; i < c.scenarios.size(); ++i) {
    options.seed = 10 * c.seed + i + 1;
    c.flights.push_back(flown(c.truth, options, c.scenarios[i]));
    c.flights.back().log.file = "log" + std::to_string(i + 1);
    if (!commands) c.flights.back().log.delta.clear();
    if (c.drift.sigma > 0) testing::drift_attitude(c.flights.back().log, c.drift, options.seed);
    if (c.shaken > 0) shake(c, c.flights.back());
    if (c.filter) testing::estimate(c.flights.back().log, c.truth.g);
  }
}

NoiseModel true_noise(const Case& c, const FlightRecord& record) {
  NoiseModel noise;
  noise.axes = GustAxes::body;
  noise.slow[kShownAttitude].fill(c.drift);
  noise.sigma = record.sigma;
  const SensorNoise sensor = noise_level("typical");
  for (std::size_t k = 0; k < 3; ++k) {
    noise.sigma[kGyro + k] = sensor.gyro, noise.sigma[kForce + k] = sensor.accelerometer;
    noise.sigma[kAttitude + k] = sensor.attitude, noise.sigma[kVelocity + k] = sensor.velocity;
    noise.sigma[kPosition + k] = sensor.position;
  }
  for (std::size_t n = kRotorChannel; n < kChannels; ++n)
    noise.sigma[n] = c.rotor_speeds ? sensor.rotor_speed * hover_speed(c.truth) : 1.0;
  const double moment = kTurn * c.truth.value("m") * c.gusts;
  AirNoise air;
  air.v_dot.fill({kPush * c.gusts, kGustTime});
  air.w_dot = {{{moment / c.truth.value("Jxx"), kGustTime},
                {moment / c.truth.value("Jyy"), kGustTime},
                {moment / c.truth.value("Jzz"), kGustTime}}};
  noise.air.assign(static_cast<std::size_t>(record.logs), air);
  return noise;
}

/// True states at the starts of the smoother's chunks.
std::vector<FlightState<double>> true_states(const Case& c, const FlightSmoother& smoother) {
  std::vector<FlightState<double>> states;
  for (const ChunkPlace& place : smoother.chunks()) {
    const FlightArc& arc = smoother.record().arcs[static_cast<std::size_t>(place.arc)];
    const SimulatedFlight& f = c.flights[static_cast<std::size_t>(arc.log)];
    const auto at = std::lower_bound(f.log.t.begin(), f.log.t.end(), arc.t[place.begin]) - f.log.t.begin();
    states.push_back(f.truth[static_cast<std::size_t>(at)]);
  }
  return states;
}

}  // namespace

std::vector<FlightLog> Case::logs() const {
  std::vector<FlightLog> all;
  for (const SimulatedFlight& f : flights) all.push_back(f.log);
  return all;
}

Case random_case(std::uint64_t seed, const CaseOptions& options) {
  Random random(seed ^ 0x9e3779b97f4a7c15ULL);
  Case c;
  c.seed = seed;
  c.truth = drawn_vehicle(seed);
  if (options.many_rotors) c.truth = with_many_rotors(c.truth, seed);
  c.stated = measured(c.truth, random);
  c.rotor_speeds = random.below(4) >= (options.many_rotors ? 2 : 1) || !options.commands;
  static const std::array<std::string, 4> second = {"mixed", "hover", "steps", "eight"};
  c.drift.sigma = options.drift, c.filter = options.filter, c.shaken = options.shaken,
  c.one_by_one = options.one_by_one;
  c.by_gyro = options.by_gyro, c.silent = options.silent;
  if (c.silent) c.stated.parameters.erase("dead_time"), c.stated.parameters.erase("Jp");
  c.scenarios = {"mixed", second[static_cast<std::size_t>(random.below(4))]};
  const double share = random.log_uniform(0.07, 0.70);
  fly(c, options.seconds, options.commands);
  if (!options.turbulence) return c;
  const Motion still = motion_of(c.flights);
  c.gusts = share * still.push / kPush;
  c.push_share = share;
  double turn = 0;
  for (const char* J : {"Jxx", "Jyy", "Jzz"}) turn += std::pow(1 / c.truth.value(J), 2) / 3;
  c.turn_share = kTurn * c.truth.value("m") * c.gusts * std::sqrt(turn) / still.turn;
  fly(c, options.seconds, options.commands);
  return c;
}

std::vector<std::pair<std::string, double>> bounds(const Case& c) {
  const std::vector<double> p = parameter_vector(c.truth);
  const std::vector<FlightLog> logs = c.logs();
  const FlightRecord record = make_flight_record(c.truth, p, logs);
  std::vector<std::string> found;
  if (c.silent) found = {"Jp"};
  if (c.silent && c.truth.value("dead_time") > 0) found.emplace_back("dead_time");
  std::vector<FreeConstant> constants = free_constants(c.stated, p, found);
  if (!record.signals.commands) leave_out_motors(constants);
  const Theta theta(p, constants, record.logs, record.signals.rates);
  FlightSmoother smoother(record, theta, true_noise(c, record), c.gusts > 0 ? 0.02 : 0.25);
  smoother.set_exact(true);
  smoother.set_states(true_states(c, smoother));
  const VectorXd u = VectorXd::Zero(theta.size());
  MatrixXd H = smoother.linearize(u).S;
  H += theta.prior(u).information();
  const VectorXd s = H.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = s.asDiagonal() * H * s.asDiagonal();
  const MatrixXd covariance =
      s.asDiagonal() * MatrixXd(scaled.ldlt().solve(MatrixXd::Identity(u.size(), u.size()))) * s.asDiagonal();
  std::vector<std::pair<std::string, double>> all;
  for (int i = 0; i < theta.constants_count(); ++i)
    all.emplace_back(theta.name(i), std::abs(theta.slope(u, i)) * std::sqrt(covariance(i, i)));
  return all;
}

Outcome refine_case(const Case& c) {
  Outcome outcome{
      .seed = c.seed, .rotor_speeds = c.rotor_speeds, .push_share = c.push_share, .turn_share = c.turn_share};
  const auto bound = bounds(c);
  const std::vector<FlightLog> logs = c.logs();
  const auto begin = std::chrono::steady_clock::now();
  Result result;
  try {
    if (!c.one_by_one) {
      result = refine_flight(c.stated, logs, {.validate = false});
    } else {
      Vehicle known = c.stated;
      for (const FlightLog& log : logs) {
        result = refine_flight(known, std::span(&log, 1), {.validate = false});
        known = with_parameters(known, with_result({}, result));
      }
    }
  } catch (const std::exception& e) {
    outcome.failure = e.what();
    return outcome;
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (const Parameter& p : result.parameters) {
    const auto same = [&](const auto& b) { return b.first == p.name; };
    const auto b = std::ranges::find_if(bound, same);
    if (b == bound.end()) {
      outcome.failure = "freed a constant that is known: " + p.name;
      continue;
    }
    const double truth = c.truth.value(p.name), error = std::abs(p.value - truth);
    const std::optional<double> stated = c.one_by_one ? c.stated.parameters.at(p.name).std : p.prior_std;
    outcome.estimates.push_back({.name = p.name,
                                 .truth = truth,
                                 .value = p.value,
                                 .std = p.std,
                                 .naive_std = p.naive_std.value_or(p.std),
                                 .prior_std = stated.value_or(kNaN),
                                 .bound = b->second,
                                 .inside = p.ci95[0] <= truth && truth <= p.ci95[1],
                                 .inside_naive = error < 1.96 * p.naive_std.value_or(p.std),
                                 .identifiable = c.one_by_one ? p.std < 0.5 * *stated : p.identifiable});
  }
  for (const auto& [name, b] : bound)
    if (std::ranges::find(result.parameters, name, &Parameter::name) == result.parameters.end())
      outcome.failure = "missed " + name;
  return outcome;
}

std::string as_line(const Outcome& o) {
  nlohmann::ordered_json line = {{"seed", o.seed},
                                 {"rotor_speeds", o.rotor_speeds},
                                 {"push", o.push_share},
                                 {"turn", o.turn_share},
                                 {"seconds", o.seconds},
                                 {"failure", o.failure},
                                 {"estimates", nlohmann::ordered_json::array()}};
  for (const Estimate& e : o.estimates)
    line["estimates"].push_back({e.name, e.truth, e.value, e.std, e.naive_std, e.prior_std, e.bound, e.inside,
                                 e.inside_naive, e.identifiable});
  return line.dump();
}

Outcome from_line(const std::string& text) {
  const auto line = nlohmann::json::parse(text);
  Outcome o{.seed = line["seed"],
            .rotor_speeds = line["rotor_speeds"],
            .push_share = line["push"],
            .turn_share = line["turn"],
            .seconds = line["seconds"],
            .failure = line["failure"]};
  const auto number = [](const nlohmann::json& x) { return x.is_null() ? kNaN : x.get<double>(); };
  for (const auto& e : line["estimates"])
    o.estimates.push_back(
        {e[0], e[1], number(e[2]), number(e[3]), number(e[4]), number(e[5]), e[6], e[7], e[8], e[9]});
  return o;
}

}  // namespace ident::flight_campaign
