// The smoother: profiles of known size, directions that nothing tells, two ways to the same system.
#include "ident/flight/smoother/smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <tuple>

#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/make_record.h"
#include "ident/flight/record/excerpts.h"
#include "support/open_loop_flight.h"
#include "support/published_hover.h"

namespace ident {
namespace {

// A centre of gravity c to the right of the origin: the model, which lacks it, misses a moment m g c about x,
// hence an angular acceleration m g c/Jxx as long as the vehicle hovers.
TEST(FlightSmoother, ConstantProfileTakesUpTheMomentOfAnOffCentreMass) {
  const Vehicle model = testing::published_vehicle();
  Vehicle truth = model;
  constexpr double c = 0.002;
  truth.parameters["cg_offset.y"] = {c, {}};
  const FlightRecord record = testing::hover_record(truth, model, 12.0);
  const std::vector<double> p = parameter_vector(model);
  const Theta theta(p, {}, 1, true);
  NoiseModel noise = initial_noise(record);
  noise.air[0].w_dot.fill({0.5, 1.0});
  noise.air[0].v_dot.fill({0.1, 1.0});
  FlightSmoother smoother(record, theta, noise, 0.1);
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
  smoother.settle(u, 3);
  smoother.linearize(u);
  smoother.set_profiles(
      std::vector<Eigen::MatrixXd>(smoother.chunks().size(), Eigen::MatrixXd(Eigen::VectorXd::Unit(6, 0))));
  const ReducedSystem& system = smoother.relinearize();
  Eigen::MatrixXd H = system.S;
  H.diagonal().head(theta.size()).array() += 1.0;  // the priors of the gyro's biases
  const Eigen::VectorXd step = -Eigen::LDLT<Eigen::MatrixXd>(H).solve(system.g);
  const double expected = model.value("m") * model.g * c / model.value("Jxx");
  EXPECT_NEAR(step[theta.size()], expected, 0.1 * expected);
}

// Six rotors, no speeds: as rotors change against each other the motion tells nothing of it, and what is
// known of the rest keeps its digits all the same.
TEST(FlightSmoother, SixRotorsWithoutMeasuredSpeedsConvergeToTheNoise) {
  Vehicle vehicle = small_quad();
  vehicle.rotors.clear();
  for (int n = 0; n < 6; ++n) {
    Rotor rotor = small_quad().rotors[static_cast<std::size_t>(n % 2)];
    rotor.r_B = {0.2 * std::cos(n * 1.0471975512), 0.2 * std::sin(n * 1.0471975512), 0};
    vehicle.rotors.push_back(rotor);
  }
  vehicle.parameters["kT"].value *= 4.0 / 6;
  SimulationOptions options;
  options.duration = 30, options.rate = 100, options.signals.rotor_speeds = 0;
  const std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), 1, true);
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
  for (const Steps steps : {Steps::fine, Steps::longest}) {
    FlightSmoother smoother(record, theta, initial_noise(record), 0.2);
    smoother.set_steps(steps);
    smoother.settle(u, 4);
    double samples = 0;
    for (const double y : record.arcs[0].y) samples += std::isfinite(y);
    const ReducedSystem& system = smoother.linearize(u);
    EXPECT_GT(system.cost, 0.5 * samples);
    EXPECT_LT(system.cost, 2.0 * samples);
    EXPECT_LT(system.fall, 1e-3 * system.cost) << "states are not at their best";
  }
}

// Without rotor speeds only kT km^2, kQ km^2 and Jp km can be known: along what they leave open neither the
// cost nor its gradient may change, whatever the motors' states take up of the noise.
TEST(FlightSmoother, TheScaleOfUnmeasuredRotorSpeedsIsNotDetermined) {
  Vehicle vehicle = testing::published_vehicle();
  for (const char* name : {"kT", "kQ", "km", "Jp"})
    vehicle.parameters[name] = {vehicle.value(name), 0.1 * vehicle.value(name)};
  SimulationOptions options;
  options.duration = 8.0;
  options.rate = 100.0;
  options.signals.rotor_speeds = 0;
  const std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), 1, true);
  NoiseModel noise = initial_noise(record);
  for (std::size_t i = 0; i < 3; ++i) noise.air[0].w_dot[i].sigma = noise.air[0].v_dot[i].sigma = 0;
  FlightSmoother smoother(record, theta, noise, 0.2);
  smoother.set_exact(true);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(theta.size());
  for (int i = 0; i < theta.constants_count(); ++i) {
    const std::string name = theta.name(i);
    along[i] = name == "km" ? 1.0 : name == "Jp" ? -1.0 : name == "kT" || name == "kQ" ? -2.0 : 0.0;
  }
  smoother.settle(Eigen::VectorXd::Zero(theta.size()), 6);
  const double here = smoother.reduced().cost, slope = 2 * smoother.reduced().g.dot(along);
  EXPECT_NEAR(slope, 0.0, 0.05);
  smoother.settle(-0.1 * along, 8);
  EXPECT_NEAR(smoother.reduced().cost, here, 0.005);
}

// The gradient is that of the cost, also where speeds off their commands make the links of noisy motors bear
// much of it: a weight that went with an unknown would bend the one and not the other.
TEST(FlightSmoother, GradientIsThatOfTheCostWithNoisyMotors) {
  Vehicle vehicle = testing::published_vehicle();
  for (const char* name : {"kT", "kQ", "km", "omega_m", "zeta_m", "Jxx"})
    vehicle.parameters[name] = {vehicle.value(name), 0.1 * vehicle.value(name)};
  SimulationOptions options;
  options.duration = 8.0;
  options.rate = 100.0;
  const std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  vehicle.parameters["km"].value *= 1.1;
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), 1, true);
  NoiseModel noise = initial_noise(record);
  noise.q_motor = 30.0;
  FlightSmoother smoother(record, theta, noise, 0.1);
  smoother.set_exact(true);
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
  smoother.settle(u, 12);
  const Eigen::VectorXd g = 2 * smoother.reduced().g;
  constexpr double kStep = 1e-3;
  for (int i = 0; i < theta.constants_count(); ++i) {
    const Eigen::VectorXd du = kStep * Eigen::VectorXd::Unit(theta.size(), i);
    const double slope = (smoother.linearize(u + du).cost - smoother.linearize(u - du).cost) / (2 * kStep);
    EXPECT_NEAR(g[i], slope, 0.01 * std::abs(slope)) << theta.name(i);
  }
}

// Elimination and the blocks of scores go two ways to the same gradient and information: forwards over what
// each chunk passes on, backwards through what the states do with the shared unknowns.
void expect_blocks_add_up(FlightSmoother& smoother) {
  const ReducedSystem system = smoother.reduced();
  Eigen::VectorXd score = Eigen::VectorXd::Zero(system.g.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(system.g.size(), system.g.size());
  for (const ScoreBlock& block : smoother.score_blocks(1.0))
    score += block.score, information += block.information;
  const Eigen::VectorXd unit = system.S.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
  EXPECT_LT((unit.asDiagonal() * (information - system.S) * unit.asDiagonal()).cwiseAbs().maxCoeff(), 1e-5);
  // The states stand where they were: what they would still gain is not in the scores of the blocks.
  EXPECT_LT(unit.cwiseProduct(score - system.g).cwiseAbs().maxCoeff(),
            1e-3 * (1 + unit.cwiseProduct(system.g).cwiseAbs().maxCoeff()));
}

TEST(FlightSmoother, EachAxisCarriesItsOwnShareOfAGust) {
  Setting s;
  NoiseModel noise = initial_noise(s.record);
  noise.air[0].w_dot = {{{0.5, 0.02}, {1.0, 0.1}, {2.0, 1.0}}};
  noise.air[0].v_dot = {{{0.2, 1.0}, {0.4, 0.1}, {0.8, 0.02}}};
  FlightSmoother smoother(s.record, s.theta, noise, 0.1, 1);
  constexpr std::size_t k = 3;
  const auto defect_with = [&](const FlightState<double>& state) {
    std::vector<FlightState<double>> states = smoother.states();
    states[k] = state;
    smoother.set_states(states);
    smoother.residuals();
    return smoother.defects()[k];
  };
  const ChunkPlace& place = smoother.chunks()[k];
  const double h = s.record.arcs[0].t[place.end] - s.record.arcs[0].t[place.begin];
  const FlightState<double> calm = smoother.states()[k];
  const Eigen::VectorXd before = defect_with(calm);
  for (int axis = 0; axis < 3; ++axis) {
    const auto of_axis = static_cast<std::size_t>(axis);
    FlightState<double> turned = calm, pushed = calm;
    turned.outside.w_dot_B[axis] += 1, pushed.outside.v_dot[axis] += 1;
    EXPECT_NEAR((defect_with(turned) - before)[s.record.layout.w_dot + axis],
                noise.air[0].w_dot[of_axis].carried(h), 1e-12);
    EXPECT_NEAR((defect_with(pushed) - before)[s.record.layout.v_dot + axis],
                noise.air[0].v_dot[of_axis].carried(h), 1e-12);
  }
}

TEST(FlightSmoother, BlocksAddUpToTheReducedSystemLinkedUnlinkedAndWithProfiles) {
  Vehicle vehicle = testing::published_vehicle();
  for (const char* name : {"kT", "kQ", "Jxx", "Jyy", "Jzz"})
    vehicle.parameters[name] = {vehicle.value(name), 0.1 * vehicle.value(name)};
  std::vector<FlightLog> logs;
  for (const std::uint64_t seed : {3, 4}) {
    SimulationOptions options;
    options.duration = seed == 3 ? 6.0 : 9.0;  // the second is eliminated from both ends
    options.rate = 100.0, options.seed = seed;
    logs.push_back(simulate_flight(vehicle, options).log);
  }
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  for (const auto& [linked, constants, axes] :
       {std::tuple{true, true, GustAxes::world}, std::tuple{true, true, GustAxes::body},
        std::tuple{true, false, GustAxes::world}, std::tuple{false, true, GustAxes::world},
        std::tuple{false, false, GustAxes::body}}) {
    const Theta theta(p, constants ? free_constants(vehicle, p) : std::vector<FreeConstant>{}, 2, true);
    NoiseModel noise = initial_noise(record);
    noise.axes = axes;
    FlightSmoother smoother(record, theta, noise, 0.15);
    smoother.set_exact(true);
    if (!linked) smoother.unlink();
    const Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
    smoother.settle(u, 6);
    expect_blocks_add_up(smoother);
    smoother.set_profiles(
        std::vector<Eigen::MatrixXd>(smoother.chunks().size(), Eigen::MatrixXd(Eigen::VectorXd::Unit(6, 4))));
    smoother.relinearize();
    smoother.accept();
    expect_blocks_add_up(smoother);
  }
}

// What is known of the last state comes from the last seconds, however much flight there was before: a long
// chain, whose ends meet in its middle, knows it as a short one does that is eliminated up to it.
TEST(FlightSmoother, TheEndOfALongChainEqualsThatOfItsLastPart) {
  Vehicle vehicle = testing::published_vehicle();
  SimulationOptions options;
  options.duration = 12.0, options.rate = 100.0, options.turbulence = 0.5;
  const std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord whole = make_flight_record(vehicle, p, logs);
  FlightRecord last = without_arcs(whole);
  last.arcs.push_back(whole.arcs[0].piece(whole.arcs[0].rows() - 351, whole.arcs[0].rows()));
  const Theta none(p, {}, 1, false);
  const auto end_of = [&](const FlightRecord& record) {
    FlightSmoother smoother(record, none, initial_noise(whole), 0.1);
    smoother.settle(Eigen::VectorXd(0), 6);
    return smoother.arc_ends().at(0);
  };
  const FlightSmoother::End of_long = end_of(whole), of_short = end_of(last);
  const Eigen::VectorXd std = of_short.P.diagonal().cwiseSqrt();
  EXPECT_LT(((of_long.P - of_short.P).array() / (std * std.transpose()).array()).abs().maxCoeff(), 0.02);
  EXPECT_LT((of_long.x.body.w_B - of_short.x.body.w_B).cwiseQuotient(std.head<3>()).norm(), 0.02);
}

// The last step of states is taken without a look at where it leads; where an arc ends moves with it. Here it
// is the first one, from what was measured.
TEST(FlightSmoother, ArcEndsFollowTheLastUnevaluatedStep) {
  const Vehicle vehicle = testing::published_vehicle();
  SimulationOptions options;
  options.duration = 4.0, options.rate = 100.0, options.turbulence = 0.5;
  const std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta none(p, {}, 1, false);
  const auto end_after = [&](int rounds) {
    FlightSmoother smoother(record, none, initial_noise(record), 0.1);
    smoother.set_huber(1e9);
    smoother.settle(Eigen::VectorXd(0), rounds, 0.0);
    return std::pair(smoother.arc_ends().at(0), smoother.reduced().fall / smoother.reduced().cost);
  };
  const auto [soon, falls] = end_after(1);
  const auto [late, fell] = end_after(8);
  const Eigen::VectorXd std = late.P.diagonal().cwiseSqrt();
  EXPECT_GT(falls, 0.1);
  EXPECT_LT(fell, 1e-6);
  EXPECT_LT((soon.x.body.w_B - late.x.body.w_B).cwiseQuotient(std.head<3>()).norm(), 0.1);
  EXPECT_LT((soon.x.body.v_W - late.x.body.v_W).cwiseQuotient(std.segment<3>(record.layout.v)).norm(), 0.1);
}

}  // namespace
}  // namespace ident
