// The generator's own checks: physics at hover, consistency of what a log shows, reproducibility, limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "chi_squared.h"
#include "detectability.h"
#include "withheld_case.h"

namespace withheld {
namespace {

using Eigen::Vector3d;

struct Scene {
  explicit Scene(std::uint64_t seed) : random(seed), vehicle(draw_vehicle(random)) {
    instruments.jitter = 0.02;
    settings.gusts.sigma = 0.1;
  }
  Flight fly_with(const Effects& e) { return fly(vehicle, e, instruments, settings, 5, 0); }

  Random random;
  Vehicle vehicle;
  Instruments instruments;
  FlightSettings settings;
};

TEST(WithheldPhysics, HoverShowsMinusG) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    Scene scene(seed);
    const Vehicle& v = scene.vehicle;
    const Motion still{Vector3d(0, 0, -3), Vector3d::Zero(), Eigen::Quaterniond::Identity(),
                       Vector3d::Zero()};
    const Four Omega = Four::Constant(v.hover_speed());
    const Wrench wrench = rotor_wrench(v, {}, still, {}, Omega, Four::Zero());
    const Acceleration a = accelerate(Body(v, {}), wrench, still.w);
    EXPECT_NEAR((a.f - Vector3d(0, 0, -9.81)).norm(), 0, 1e-9);
    // tan(alpha) = 2 kQ/(l kT) balances the 4SP's torque to first order in alpha only.
    EXPECT_NEAR(a.dw.norm(), 0, v.layout == "4sp" ? 1 : 1e-6);
    EXPECT_GT(v.J.x() + v.J.y(), v.J.z());
    EXPECT_GT(v.J.y() + v.J.z(), v.J.x());
    EXPECT_GT(v.J.x() + v.J.z(), v.J.y());
  }
}

TEST(WithheldPhysics, MassesOutOfPlaceKeepForceEqualToMassTimesAcceleration) {
  Scene scene(3);
  Effects e;
  e.cg = Vector3d(0.01, -0.005, 0.004);
  e.payload = 0.2 * scene.vehicle.m;
  e.payload_at = Vector3d(0.03, 0.02, -0.01);
  const Body body(scene.vehicle, e);
  const Wrench wrench{Vector3d(1, 2, -9), Vector3d(0.01, 0.02, -0.03)};
  const Vector3d w(1, -2, 0.5);
  const Acceleration a = accelerate(body, wrench, w);
  const Vector3d at_cg = a.f + a.dw.cross(body.c) + w.cross(w.cross(body.c));
  EXPECT_NEAR((body.m * at_cg - wrench.F).norm(), 0, 1e-9);
  const Vector3d M = body.J * a.dw + w.cross(body.J * w) + body.c.cross(wrench.F);
  EXPECT_NEAR((M - wrench.M).norm(), 0, 1e-9);
}

TEST(WithheldFlight, AttitudeFollowsRatesAndPositionFollowsVelocity) {
  Scene scene(9);
  const Flight flight = scene.fly_with({});
  ASSERT_TRUE(flight.flown);
  for (std::size_t k = 0; k + 1 < flight.truth.size(); ++k) {
    const Instant &a = flight.truth[k], &b = flight.truth[k + 1];
    const double h = b.t - a.t;
    const Eigen::Quaterniond turned = a.motion.q * small_turn(h * (a.motion.w + b.motion.w) / 2);
    EXPECT_LT(turned.angularDistance(b.motion.q), 5e-4);
    EXPECT_LT((a.motion.p + h * (a.motion.v + b.motion.v) / 2 - b.motion.p).norm(), 1e-4);
    const Vector3d acceleration = a.motion.q * a.acceleration.f + Vector3d(0, 0, 9.81);
    EXPECT_LT((a.motion.v + h * acceleration - b.motion.v).norm(), 5e-3);
    EXPECT_NEAR(b.motion.q.norm(), 1, 1e-9);
  }
}

TEST(WithheldFlight, NoiseIsAsStated) {
  Scene scene(9);
  const Flight flight = scene.fly_with({});
  double gyro = 0, acc = 0;
  Vector3d bias = Vector3d::Zero();
  const auto n = static_cast<double>(flight.rows.size());
  for (std::size_t k = 0; k < flight.rows.size(); ++k)
    bias += (flight.rows[k].shown.gyro - flight.truth[k].motion.w) / n;
  for (std::size_t k = 0; k < flight.rows.size(); ++k) {
    gyro += (flight.rows[k].shown.gyro - flight.truth[k].motion.w - bias).squaredNorm() / (3 * n);
    acc += (flight.rows[k].shown.acc - flight.truth[k].acceleration.f).squaredNorm() / (3 * n);
  }
  EXPECT_NEAR(std::sqrt(gyro) / scene.instruments.gyro, 1, 0.02);
  EXPECT_NEAR(std::sqrt(acc) / scene.instruments.acc, 1, 0.02);
}

// Along its own trajectory the prediction must give back what was flown, with every effect that it knows.
TEST(WithheldInformation, PredictionWithTheTruthIsTheRecordedFlight) {
  for (const std::string& name : catalogue_names()) {
    Scene scene(9);
    Random random(4);
    const Member member = draw_member(name, scene.vehicle, random);
    Effects e;
    member.accompany(e);
    if (name.rfind("imu", 0) == 0 || name == "sensor_delay")
      continue;  // recorded() is what happened, not shown
    member.apply(e, 0.3);
    const Flight flight = scene.fly_with(e);
    ASSERT_TRUE(flight.flown) << name;
    Prediction predict(flight, scene.instruments);
    const Channels difference = predict(scene.vehicle, e) - predict.recorded();
    const Eigen::Index from = 30;  // the first command's predecessors are not in the log
    EXPECT_LT(difference.middleCols<3>(0).bottomRows(difference.rows() - from).cwiseAbs().maxCoeff(), 2e-3)
        << name;
    EXPECT_LT(difference.rightCols<4>().bottomRows(difference.rows() - from).cwiseAbs().maxCoeff(),
              1e-3 * scene.vehicle.hover_speed())
        << name;
  }
}

TEST(WithheldInformation, DetectionLimitOfOneParameterIsTheSumOfTwoQuantiles) {
  // z(1 - 0.01/42) = 3.4937, z(0.9) = 1.2816; the far tail adds nothing.
  EXPECT_NEAR(std::sqrt(required_noncentrality(1)), 3.4937 + 1.2816, 2e-3);
  EXPECT_NEAR(chi_squared_upper(3.841459, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi_squared_upper(7.814728, 3), 0.05, 1e-6);
}

TEST(WithheldCase, TheSameSeedGivesTheSameCase) {
  const CaseOrder order{"single", {"rotor_drag"}, 5};
  const Case a = draw_case(11, 3, order), b = draw_case(11, 3, order);
  ASSERT_EQ(a.flights[1].rows.size(), b.flights[1].rows.size());
  EXPECT_EQ(a.flights[1].rows.back().shown.acc, b.flights[1].rows.back().shown.acc);
  EXPECT_EQ(a.withheld[0].over_limit, b.withheld[0].over_limit);
}

TEST(WithheldCase, TheWantedSizeIsMet) {
  const Case drawn = draw_case(12, 1, {"single", {"rotor_drag"}, 5});
  EXPECT_NEAR(drawn.withheld[0].over_limit, 5, 1.5);
}

TEST(WithheldCase, LogsOfSpeedsHideNothingThatTheyCannotShow) {
  int with_motors = 0;
  for (int index = 0; index < 400; ++index) {
    const auto hidden = [](const CaseOrder& order) {
      return std::any_of(order.members.begin(), order.members.end(), acts_before_rotor_speed);
    };
    EXPECT_FALSE(hidden(campaign_order(1, index, "", false)));
    with_motors += hidden(campaign_order(1, index, "", true));
  }
  EXPECT_GT(with_motors, 20);
  CaseOrder order{"single", {"rotor_drag"}, 5};
  order.commands = false;
  EXPECT_TRUE(draw_case(13, 1, order).instruments.rotor_speeds);
}

// The same case with white sensors and with others, which are only logged: it flies the same.
std::array<Case, 2> with_other_sensors(bool CaseOrder::*others) {
  CaseOrder order{"none", {}};
  Case white = draw_case(14, 1, order);
  order.*others = true;
  std::array<Case, 2> both{std::move(white), draw_case(14, 1, order)};
  const auto &a = both[0].flights[0], &b = both[1].flights[0];
  EXPECT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t k = 0; k < std::min(a.rows.size(), b.rows.size()); ++k)
    EXPECT_EQ(a.truth[k].motion.p, b.truth[k].motion.p) << k;
  return both;
}

TEST(WithheldCase, AnEstimatorIsOffSlowlyAndFliesTheSame) {
  const auto [white, slow] = with_other_sensors(&CaseOrder::estimator);
  const auto &a = white.flights[0], &b = slow.flights[0];
  double square = 0, change = 0;
  for (std::size_t k = 0; k < a.rows.size(); ++k) {
    EXPECT_LT((b.rows[k].shown.v - a.rows[k].shown.v - (b.rows[0].shown.v - a.rows[0].shown.v)).norm(),
              1e-12);
    const auto off = [&](std::size_t row) {
      return Eigen::Vector3d((a.rows[row].shown.q.conjugate() * b.rows[row].shown.q).vec());
    };
    square += off(k).squaredNorm();
    if (k > 0) change += (off(k) - off(k - 1)).squaredNorm();
  }
  EXPECT_GT(square, 0);
  EXPECT_LT(change, 0.02 * square);
}

TEST(WithheldCase, AFilterMakesRatesLateAndNothingElse) {
  const auto [white, filtered] = with_other_sensors(&CaseOrder::filtered);
  const auto &a = white.flights[0], &b = filtered.flights[0];
  const double late = std::sqrt(2.0) / (2 * 3.14159265358979323846 * filtered.instruments.filter);
  double prompt = 0, lagging = 0;  // squares against the motion then, and as it was
  for (std::size_t k = 50; k < a.rows.size(); ++k) {
    ASSERT_EQ(a.rows[k].shown.v, b.rows[k].shown.v) << k;
    const Eigen::Vector3d w = b.truth[k].motion.w, before = w - late * b.truth[k].acceleration.dw;
    const Eigen::Vector3d shown = b.rows[k].shown.gyro;
    prompt += (shown - w).squaredNorm(), lagging += (shown - before).squaredNorm();
  }
  EXPECT_LT(lagging, prompt);
}

}  // namespace
}  // namespace withheld
