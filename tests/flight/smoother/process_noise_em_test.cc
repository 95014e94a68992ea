// States and noise of the smoother: taken over, at their best, most likely.
#include <gtest/gtest.h>

#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/make_record.h"
#include "support/published_hover.h"

namespace ident {
namespace {

// The published vehicle in turbulence, with all constants known.
struct Gusty {
  explicit Gusty(double seconds)
      : logs{simulate_flight(vehicle, {.duration = seconds, .rate = 100.0, .turbulence = 0.5}).log} {}

  Vehicle vehicle = testing::published_vehicle();
  std::vector<double> p = parameter_vector(vehicle);
  std::vector<FlightLog> logs;
  FlightRecord record = make_flight_record(vehicle, p, logs);
  Theta theta{p, {}, 1, true};
  Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
};

// States that are taken over lie where the other smoother has them, also where chunks begin elsewhere.
TEST(FlightSmoother, TakesOverStatesOfASmootherWithOtherChunks) {
  const Gusty flight(8.0);
  const auto& [vehicle, p, logs, record, theta, u] = flight;
  FlightSmoother one(record, theta, initial_noise(record), 0.1), other(record, theta, one.noise(), 0.15);
  one.settle(u, 10, 1e-9);
  other.start_from(one);
  for (std::size_t k = 0, same = 0; k < other.chunks().size(); ++k) {
    while (one.chunks()[same].end <= other.chunks()[k].begin) ++same;
    const FlightState<double>&a = one.states()[same], &b = other.states()[k];
    if (one.chunks()[same].begin == other.chunks()[k].begin) {
      EXPECT_EQ(a.body.w_B, b.body.w_B) << k;
    }
    EXPECT_EQ(a.outside.v_dot, b.outside.v_dot) << k;
  }
  // One step from there leaves less than one from what was measured.
  FlightSmoother measured(record, theta, one.noise(), 0.15);
  other.settle(u, 1), measured.settle(u, 1);
  EXPECT_LT(other.linearize(u).fall, 0.2 * measured.linearize(u).fall);
}

// Gross errors bend the cost, and each step to and fro promises a fall that none keeps: the rounds end all
// the same, at states that no further round betters.
TEST(FlightSmoother, SettlingEndsWhenRoundsNoLongerLowerTheCost) {
  const Vehicle vehicle = testing::published_vehicle();
  SimulationOptions options;
  options.duration = 8.0, options.rate = 100.0;
  std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  for (std::size_t i = 0; i < logs[0].rows(); i += 3) logs[0].v_W[0][i] += i % 2 == 0 ? 3.0 : -3.0;
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, {}, 1, true);
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
  NoiseModel noise = initial_noise(record);
  noise.sigma[kVelocity] = 0.01;
  FlightSmoother few(record, theta, noise, 0.1), many(record, theta, noise, 0.1);
  few.settle(u, 30, 1e-3);
  for (int i = 0; i < 30; ++i) many.settle(u, 1);
  EXPECT_NEAR(few.reduced().cost / many.reduced().cost, 1.0, 5e-3);
}

// The last step is theirs: where states end is known a round before they are there, and not earlier where
// rounds lead there slowly.
TEST(FlightSmoother, SettlingForArcEndsGivesTheEndsOfFullConvergence) {
  for (const bool few_sensors : {false, true}) {
    Gusty flight(8.0);
    if (few_sensors) {
      for (auto& column : flight.logs[0].f_B) column.clear();
      for (auto& column : flight.logs[0].v_W) column.clear();
      for (auto& column : flight.logs[0].q_WB) column.clear();
      flight.logs[0].Omega.clear();
      flight.record = make_flight_record(flight.vehicle, flight.p, flight.logs);
    }
    const NoiseModel noise = initial_noise(flight.record);
    FlightSmoother few(flight.record, flight.theta, noise, 0.1),
        many(flight.record, flight.theta, noise, 0.1);
    few.settle_ends(flight.u, 30, 1e-3);
    many.settle(flight.u, 60, 1e-12);
    const auto a = few.arc_ends(), b = many.arc_ends();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
      for (Eigen::Index i = 0; i < 3; ++i) {
        const double std = std::sqrt(b[k].P(flight.record.layout.v + i, flight.record.layout.v + i));
        EXPECT_NEAR(a[k].x.body.v_W[i], b[k].x.body.v_W[i], 0.1 * std) << few_sensors << ' ' << i;
      }
  }
}

// In a search chunks are twice as long as no gust within them shows, and none shorter than a tenth of a
// second.
TEST(FlightSmoother, ChunksOfASearchAreTwiceAsLongAsThoseOfARefinement) {
  const Gusty flight(3.0);
  NoiseModel noise = initial_noise(flight.record);
  for (const double gust : {0.01, 0.1, 1.0, 10.0}) {
    noise.air[0].w_dot.fill({gust, 0.5}), noise.air[0].v_dot.fill({gust, 0.5});
    const double fine = chunk_for(flight.record, noise), search = chunk_for(flight.record, noise, false);
    EXPECT_DOUBLE_EQ(search, std::clamp(2 * fine, 0.1, 0.25)) << gust;
  }
}

// Steps of lower order push the vehicle a little. In gusts that is nothing; where there are none it would
// pass for what acts on it.
TEST(FlightSmoother, IntegrationErrorShowsInStillAir) {
  const Gusty flight(8.0);
  FlightSmoother smoother(flight.record, flight.theta, initial_noise(flight.record), 0.1);
  smoother.set_steps(Steps::coarse);
  const auto worth = [&](double gust) {
    NoiseModel noise = smoother.noise();
    noise.air[0].w_dot.fill({gust, 0.5}), noise.air[0].v_dot.fill({gust, 0.5});
    smoother.set_noise(noise);
    smoother.settle(flight.u, 3);
    return smoother.worth_of_fine_steps().links;
  };
  const double gusty = worth(0.3), still = worth(1e-4);
  EXPECT_GT(gusty, 0);
  EXPECT_GT(still, 1e5 * gusty);
  smoother.set_steps(Steps::fine);
  EXPECT_EQ(smoother.worth_of_fine_steps().links, 0);
}

// The same by the density of the process, axis by axis.
TEST(FlightSmoother, IntegrationErrorIsWeightedByTheProcessNoise) {
  const Gusty flight(4.0);
  FlightSmoother smoother(flight.record, flight.theta, initial_noise(flight.record), 0.1);
  constexpr double sigma = 0.02, tau = 0.3;
  NoiseModel noise = smoother.noise();
  noise.air[0].w_dot.fill({sigma, tau}), noise.air[0].v_dot.fill({sigma, tau});
  smoother.set_noise(noise);
  smoother.settle(flight.u, 3);
  const auto defects_by = [&](Steps steps) {
    smoother.set_steps(steps);
    (void)smoother.residuals();
    return smoother.defects();
  };
  const auto fine = defects_by(Steps::fine), coarse = defects_by(Steps::coarse);
  const StateLayout& layout = flight.record.layout;
  double expected = 0;
  for (const int from : {layout.w, layout.v})
    for (int i = from; i < from + 3; ++i) {
      double before = 0;
      for (std::size_t k = 0; k + 1 < fine.size(); ++k) {
        const ChunkPlace& place = smoother.chunks()[k];
        const std::vector<double>& t = flight.record.arcs[0].t;
        const double push = (fine[k][i] - coarse[k][i]) / (t[place.end] - t[place.begin]);
        // What is carried over is that of the link from the chunk before.
        const double last = k > 0 ? t[place.begin] - t[smoother.chunks()[k - 1].begin] : 0.0;
        const double carried = k > 0 ? std::exp(-last / tau) : 0.0;
        const double fresh = push - carried * before;
        expected += fresh * fresh / (sigma * sigma * (1 - carried * carried));
        before = push;
      }
    }
  EXPECT_NEAR(smoother.worth_of_fine_steps().links / expected, 1.0, 1e-3);
}

// Slow gusts, of which the time says little: their noise and that time follow each other, to and fro unless
// steps become shorter.
TEST(FlightSmoother, NoiseEstimateOfSlowGustsConverges) {
  const Gusty flight(30.0);
  const auto& [vehicle, p, logs, record, theta, u] = flight;
  FlightSmoother smoother(record, theta, initial_noise(record), 0.05);
  smoother.settle(u, 3);
  smoother.retune(30);
  const NoiseModel there = smoother.noise();
  for (int more = 1; more <= 4; ++more) {
    smoother.retune(2);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(smoother.noise().air[0].v_dot[k].sigma / there.air[0].v_dot[k].sigma, 1.0, 0.03) << k;
  }
}

// Motors that do as they are commanded: what noise of theirs is left below the floor of the links is none,
// and takes no rounds to become less and less.
TEST(FlightSmoother, MotorNoiseBelowTheFloorIsEstimatedAsZero) {
  const Gusty flight(20.0);
  const auto& [vehicle, p, logs, measured, theta, u] = flight;
  std::vector<FlightLog> unmeasured = logs;
  unmeasured[0].Omega.clear();
  const FlightRecord record = make_flight_record(vehicle, p, unmeasured);
  NoiseModel noise = initial_noise(record);
  noise.q_motor = 1e-4;
  FlightSmoother smoother(record, theta, noise, 0.1);
  smoother.settle(u, 3);
  smoother.retune(4);
  EXPECT_LT(smoother.noise().q_motor, 1e-8);
}

// What speeds and rates hardly tell of it does not stay where it was begun, to stand in for other noise.
TEST(FlightSmoother, MotorNoiseThatTheDataHardlyDetermineIsEstimatedAsZero) {
  const Gusty flight(20.0);
  const auto& [vehicle, p, logs, record, theta, u] = flight;
  NoiseModel noise = initial_noise(record);
  noise.q_motor = 1.0;
  FlightSmoother smoother(record, theta, noise, 0.03);
  smoother.settle(u, 3);
  smoother.retune(6);
  EXPECT_LT(smoother.noise().q_motor, 1e-3);
}

// The noise that makes a flight most likely does not depend on how often the shared unknowns are found anew
// on the way there.
TEST(FlightSmoother, HoldingTheSharedUnknownsForSomeRoundsGivesTheSameNoise) {
  Vehicle vehicle = testing::published_vehicle();
  SimulationOptions options;
  options.duration = 20.0, options.rate = 100.0, options.turbulence = 0.5;
  const std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
  for (const char* name : {"kT", "kQ", "Jxx", "Jyy", "Jzz"})
    vehicle.parameters[name] = {1.1 * vehicle.value(name), 0.1 * vehicle.value(name)};
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p), 1, true);
  const auto smoother_at_start = [&] {
    FlightSmoother smoother(record, theta, initial_noise(record), 0.15);
    smoother.settle(Eigen::VectorXd::Zero(theta.size()), 3);
    smoother.linearize(Eigen::VectorXd::Zero(theta.size()));
    return smoother;
  };
  FlightSmoother held = smoother_at_start(), free = smoother_at_start();
  held.retune(24);
  for (int round = 0; round < 24; ++round) free.retune(1);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(held.noise().air[0].v_dot[k].sigma / free.noise().air[0].v_dot[k].sigma, 1.0, 0.02) << k;
    EXPECT_NEAR(held.noise().air[0].w_dot[k].sigma / free.noise().air[0].w_dot[k].sigma, 1.0, 0.02) << k;
  }
  EXPECT_NEAR(held.reduced().cost / free.reduced().cost, 1.0, 0.01);
  // What makes the flight most likely surprises least.
  const NoiseModel best = held.noise();
  const double least = held.surprise();
  for (const double factor : {0.7, 1.4})
    for (const bool push : {true, false}) {
      NoiseModel other = best;
      for (ColouredNoise& axis : push ? other.air[0].v_dot : other.air[0].w_dot) axis.sigma *= factor;
      held.set_noise(other);
      held.relinearize();
      EXPECT_GT(held.surprise(), least + 1) << factor << " " << push;
    }
}

}  // namespace
}  // namespace ident
