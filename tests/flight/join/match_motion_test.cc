// A recording of the same flight is laid where it belongs, with the clock and the axes that it was made with;
// what is no recording of it, or could lie in several places, is refused.
#include "ident/flight/join/match_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/core/random.h"
#include "ident/flight/join/join_motion.h"
#include "support/late_streams.h"
#include "support/random_vehicle.h"

namespace ident {
namespace {

using namespace testing;  // flights of support/, not GoogleTest's

// How a device recorded a flight: its clock, the axes of its body in those of the vehicle, its noise.
struct Device {
  double offset = 0.0, drift = 0.0;  // s of the log less its own; s a second
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  double noise = 0.0;  // rad
  double from = 0.0, until = 1e9;
};

double by_its_clock(const Device& device, double t) { return (t - device.offset) / (1 + device.drift); }

FlightLog recorded(const FlightLog& log, const Device& device, std::uint64_t seed = 1) {
  Random random(seed);
  FlightLog out;
  out.file = "capture.csv";
  const Eigen::Vector4d by(device.turn.w(), device.turn.x(), device.turn.y(), device.turn.z());
  for (std::size_t i = 0; i < log.rows(); i += 2) {
    if (log.t[i] < device.from || log.t[i] > device.until) continue;
    out.t.push_back(by_its_clock(device, log.t[i]));
    Eigen::Vector4d q(log.q_WB[0][i], log.q_WB[1][i], log.q_WB[2][i], log.q_WB[3][i]);
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    q = quaternion_product(Eigen::Vector4d(quaternion_product(q, by)),
                           quaternion_from_rotation_vector(Eigen::Vector3d(device.noise * noise)));
    for (std::size_t k = 0; k < 4; ++k) out.q_WB[k].push_back(q[static_cast<Eigen::Index>(k)]);
    for (std::size_t k = 0; k < 3; ++k) out.x_W[k].push_back(log.x_W[k][i]);
  }
  return out;
}

Eigen::Quaterniond turned(double degrees, const Eigen::Vector3d& about) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * M_PI / 180, about.normalized()));
}

TEST(MatchMotion, FindsClockAndAxes) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const FlightLog log = simulated(random_vehicle(seed), "mixed", seed);
    const Device device{.offset = 1000.123456 * (seed % 2 == 0 ? 1 : -1),
                        .drift = 3e-5,
                        .turn = turned(20.0 * static_cast<double>(seed), {0.2, -0.3, 1.0}),
                        .noise = 1e-3};
    const MotionMatch match = match_motion(log, recorded(log, device, seed));
    EXPECT_NEAR(match.to_log(by_its_clock(device, 12.0)), 12.0, 4 * match.std) << seed;
    EXPECT_LT(match.std, 1e-3) << seed;
    EXPECT_GT(match.alike, 0.9) << seed;
    // The turn goes from the recorded axes to the vehicle's.
    const Eigen::AngleAxisd left(Eigen::Quaterniond(match.turn) * device.turn.inverse());
    EXPECT_LT(left.angle(), 0.01) << seed;
    EXPECT_LT(match.turn_std, 0.01) << seed;
  }
}

TEST(MatchMotion, TheOffsetIsAsSureAsItClaims) {
  const FlightLog log = simulated(random_vehicle(3), "mixed", 3);
  double square = 0;
  constexpr int kTimes = 40;
  for (int i = 0; i < kTimes; ++i) {
    const Device device{.offset = 5.0 + 0.0013 * i, .noise = 2e-3};
    const MotionMatch match = match_motion(log, recorded(log, device, static_cast<std::uint64_t>(100 + i)));
    const double off = (match.to_log(by_its_clock(device, 12.5)) - 12.5) / match.std;
    square += off * off / kTimes;
  }
  EXPECT_LT(square, 2.0);  // chance leaves 0.6 to 1.5
}

TEST(MatchMotion, AShortPartIsEnough) {
  const FlightLog log = simulated(random_vehicle(2), "mixed", 2);
  const Device device{.offset = -3.3, .noise = 1e-3, .from = 8.0, .until = 20.0};
  const MotionMatch match = match_motion(log, recorded(log, device));
  EXPECT_NEAR(match.to_log(by_its_clock(device, 15.0)), 15.0, 1e-3);
}

TEST(MatchMotion, RefusesAnotherFlight) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Vehicle vehicle = random_vehicle(seed);
    const FlightLog log = simulated(vehicle, "mixed", seed), other = simulated(vehicle, "eight", seed);
    EXPECT_THROW(match_motion(log, recorded(other, {.noise = 1e-3})), DataError) << seed;
  }
}

TEST(MatchMotion, RefusesAMotionThatRepeatsItself) {
  FlightLog log = simulated(random_vehicle(3), "hover", 3);
  Random random(5);
  Vec4<double> q(1, 0, 0, 0);
  for (std::size_t i = 0; i < log.rows(); ++i) {
    const double phase = 2 * M_PI * log.t[i] / 2.5;
    const Eigen::Vector3d w(0.8 * std::sin(phase), 0.8 * std::cos(2 * phase), 0.2 * std::sin(phase));
    for (std::size_t k = 0; k < 3; ++k)
      log.w_B[k][i] = w[static_cast<Eigen::Index>(k)] + 0.01 * random.normal();
    for (std::size_t k = 0; k < 4; ++k) log.q_WB[k][i] = q[static_cast<Eigen::Index>(k)];
    q = quaternion_product(q, quaternion_from_rotation_vector(Vec3<double>(w / kRate))).normalized();
  }
  try {
    match_motion(log, recorded(log, {.noise = 1e-3, .from = 5.0, .until = 17.0}));
    FAIL() << "laid somewhere";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("in several ways"), std::string::npos) << error.what();
  }
}

TEST(JoinMotion, TakesTheRecordingInThePlaceOfTheLogsOwn) {
  const FlightLog log = simulated(random_vehicle(1), "mixed", 1);
  FlightLog drifting = log;
  for (std::size_t i = 0; i < log.rows(); ++i) drifting.x_W[0][i] += 3.0, drifting.v_W[0][i] += 1.0;
  const Device device{.offset = 42.0 + 0.7e-3, .turn = turned(90, {0, 0, 1}), .from = 4.0};
  const FlightLog recording = recorded(log, device), joined = with_motion(drifting, recording);
  EXPECT_FALSE(joined.has_velocity());  // the recording has none, and an estimator's is not mixed in
  ASSERT_TRUE(std::ranges::is_sorted(joined.t, std::less_equal()));
  std::size_t seen = 0, of_log = 0;
  for (std::size_t i = 0; i < joined.rows(); ++i) {
    while (of_log + 1 < log.rows() && log.t[of_log + 1] <= joined.t[i]) ++of_log;
    EXPECT_EQ(joined.delta[2][i], log.delta[2][of_log]) << joined.t[i];
    if (!std::isfinite(joined.q_WB[0][i])) continue;
    EXPECT_EQ(joined.x_W[0][i], recording.x_W[0][seen]);
    EXPECT_NEAR(joined.t[i], device.offset + recording.t[seen], 3e-3);
    // The vehicle's axes are those of the recorded body turned back.
    Eigen::Vector4d axes(recording.q_WB[0][seen], recording.q_WB[1][seen], recording.q_WB[2][seen],
                         recording.q_WB[3][seen]);
    axes = quaternion_product(axes, Eigen::Vector4d(std::sqrt(0.5), 0, 0, -std::sqrt(0.5)));
    double same = 0;
    for (std::size_t k = 0; k < 4; ++k) same += joined.q_WB[k][i] * axes[static_cast<Eigen::Index>(k)];
    EXPECT_GT(std::abs(same), std::cos(0.01)) << joined.t[i];
    ++seen;
  }
  EXPECT_EQ(seen, recording.rows());
  ASSERT_EQ(joined.left_out.size(), 1U);  // before the recording begins
  EXPECT_NEAR(joined.left_out[0][1], 4.0, 0.02);
  EXPECT_NE(joined.notices.back().find("capture.csv"), std::string::npos) << joined.notices.back();
}

}  // namespace
}  // namespace ident
