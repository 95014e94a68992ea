// The server over loopback: flown by a small ArduPilot in lockstep and a small Betaflight against the clock.
#include "ident/fly/serve.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "ident/core/error.h"
#include "ident/fly/autopilots.h"
#include "support/fake_autopilot.h"
#include "support/flown_vehicle.h"

namespace ident {
namespace {

using testing::FakeArduPilot;

/// A server in a thread of its own, on a free port.
class Running {
 public:
  explicit Running(const std::string& name, const Vehicle& vehicle = testing::flown_quad(),
                   ServeOptions options = {})
      : autopilot_(find_autopilot(name).make("released")) {
    options.stop = [this] { return stop_.load(); };
    options.record = true;
    options.rotor_of_output = autopilot_->order(vehicle).rotor_of_output;
    server_ = std::make_unique<Server>(*autopilot_, vehicle, options);
    thread_ = std::thread([this] { served_ = server_->run(); });
  }
  ~Running() { end(); }

  std::uint16_t port() const { return server_->port(); }
  const Served& end() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    return served_;
  }

 private:
  std::unique_ptr<Autopilot> autopilot_;
  std::unique_ptr<Server> server_;
  std::atomic<bool> stop_ = false;
  Served served_;
  std::thread thread_;
};

double up(const FakeArduPilot& pilot) { return -pilot.state["position"][2].get<double>(); }

TEST(Serve, ArduPilotClimbsAndHovers) {
  Running server("ardupilot");
  FakeArduPilot pilot(server.port());
  pilot.fly({.climb = 1.5}, 3);
  EXPECT_GT(up(pilot), 2.0);
  pilot.fly({}, 2);
  const double height = up(pilot);
  pilot.fly({}, 3);
  EXPECT_NEAR(up(pilot), height, 0.5);
  EXPECT_NEAR(pilot.state["imu"]["accel_body"][2], -9.81, 0.3);
  EXPECT_EQ(pilot.state["battery"]["voltage"], 14.8);
  const Served& served = server.end();
  EXPECT_EQ(served.frames, 8U * 400);
  EXPECT_NEAR(served.seconds, 8.0, 1e-6);
  EXPECT_EQ(served.lost + served.repeated + served.restarts + served.refused.size(), 0U);
}

TEST(Serve, ArduPilotRollsRightPitchesDownAndYawsRight) {
  Running server("ardupilot");
  FakeArduPilot pilot(server.port());
  pilot.fly({.climb = 1.5}, 3);
  pilot.fly({.roll = 0.2}, 1);
  EXPECT_NEAR(pilot.attitude().roll, 0.2, 0.05);
  EXPECT_GT(pilot.state["velocity"][1], 0.8);  // east
  pilot.fly({.roll = -0.2}, 1.2);
  pilot.fly({.pitch = -0.2}, 1);
  EXPECT_NEAR(pilot.attitude().pitch, -0.2, 0.05);
  EXPECT_GT(pilot.state["velocity"][0], 0.8);  // north
  pilot.fly({.pitch = 0.2}, 1.2);
  pilot.fly({}, 0.5);
  const double before = pilot.attitude().yaw;
  pilot.fly({.yaw_rate = 0.6}, 1.5);
  EXPECT_GT(pilot.attitude().yaw - before, 0.4);
  EXPECT_GT(pilot.state["quaternion"][3], 0.15);
}

// Without a controller, so that no loop hides a sign: from hover one pair of motors is raised by 2 %.
TEST(Serve, EachPairOfMotorsTurnsTheBodyAsInItsFrame) {
  struct Pair {
    std::array<double, 4> more;
    int axis;
  };
  for (const Pair& pair : {Pair{{0, 20, 20, 0}, 0}, Pair{{20, 0, 20, 0}, 1}, Pair{{20, 20, 0, 0}, 2}}) {
    Running server("ardupilot");
    FakeArduPilot pilot(server.port());
    pilot.fly({.climb = 1.5}, 2);
    const double before = pilot.state["imu"]["gyro"][static_cast<std::size_t>(pair.axis)];
    std::array<double, 4> pulses{};
    for (std::size_t i = 0; i < 4; ++i) pulses[i] = 1500 + pair.more[i];
    for (int i = 0; i < 80; ++i) pilot.frame(pulses);
    for (std::size_t k = 0; k < 3; ++k) {
      const double rate = pilot.state["imu"]["gyro"][k];
      if (static_cast<int>(k) == pair.axis)
        EXPECT_GT(rate - before, 0.02) << k;
      else
        EXPECT_LT(std::abs(rate), 0.1) << k << " while " << pair.axis << " is turned";
    }
  }
}

TEST(Serve, ARepeatedFrameHasTheSameAnswer) {
  Running server("ardupilot");
  FakeArduPilot pilot(server.port());
  pilot.fly({.climb = 1.0}, 0.5);
  const std::string packet = testing::servo_packet(400, pilot.count, {1600, 1600, 1600, 1600});
  const std::string first = pilot.exchange(packet), second = pilot.exchange(packet);
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, second);
  const Served& served = server.end();
  EXPECT_EQ(served.repeated, 1U);
  EXPECT_EQ(served.frames, 201U);
}

TEST(Serve, ACountThatGoesBackStartsOnTheGroundAgain) {
  Running server("ardupilot");
  FakeArduPilot pilot(server.port());
  pilot.fly({.climb = 1.5}, 2);
  ASSERT_GT(up(pilot), 1.0);
  pilot.count = 0;
  pilot.frame({1000, 1000, 1000, 1000});
  EXPECT_NEAR(up(pilot), 0.0, 1e-6);
  EXPECT_NEAR(pilot.state["timestamp"], 1.0 / 400, 1e-12);
  const Served& served = server.end();
  EXPECT_EQ(served.restarts, 1U);
  EXPECT_EQ(served.log.rows(), 1U);
}

TEST(Serve, FramesThatNeverCameAreCounted) {
  Running server("ardupilot");
  FakeArduPilot pilot(server.port());
  pilot.fly({}, 0.1);
  pilot.count += 7;
  pilot.fly({}, 0.1);
  EXPECT_EQ(server.end().lost, 7U);
}

TEST(Serve, GarbageIsCountedNamedAndNotAnswered) {
  Running server("ardupilot");
  FakeArduPilot pilot(server.port());
  pilot.fly({}, 0.1);
  EXPECT_EQ(pilot.exchange("", 0.05), "");
  EXPECT_EQ(pilot.exchange("hello", 0.05), "");
  EXPECT_EQ(pilot.exchange("hello", 0.05), "");
  EXPECT_EQ(pilot.exchange(std::string(60000, 'x'), 0.05), "");
  pilot.fly({}, 0.1);
  EXPECT_TRUE(pilot.state.is_object());
  const Served& served = server.end();
  EXPECT_EQ(served.refused.at("5 bytes, too few for a servo packet"), 2U);
  EXPECT_EQ(served.refused.at("0 bytes, too few for a servo packet"), 1U);
  EXPECT_EQ(served.frames, 80U);
}

// Every length and all kinds of bytes: nothing but a count comes of it, and kinds are bounded.
TEST(Serve, SurvivesAThousandRandomDatagrams) {
  Running server("ardupilot");
  FakeArduPilot pilot(server.port());
  std::uint32_t state = 7;
  for (int i = 0; i < 1000; ++i) {
    std::string bytes(static_cast<std::size_t>(i % 90), '\0');
    for (char& c : bytes) state = state * 1664525U + 1013904223U, c = static_cast<char>(state >> 24);
    pilot.exchange(bytes, 0.0);
    if (i % 100 == 0) pilot.frame({1000, 1000, 1000, 1000});
  }
  EXPECT_TRUE(pilot.frame({1000, 1000, 1000, 1000}).is_object());
  EXPECT_LE(server.end().refused.size(), 21U);
}

TEST(Serve, AWideServoPacketFliesAsWell) {
  Running server("ardupilot");
  FakeArduPilot pilot(server.port());
  const std::string line = pilot.exchange(testing::servo_packet(1000, 0, {1100, 1100, 1100, 1100}, true));
  EXPECT_EQ(nlohmann::json::parse(line)["timestamp"], 1e-3);
}

// Pulses below the command range of the vehicle file mean 0, and half of it means half.
TEST(Serve, PulsesCountInTheCommandRangeOfTheVehicle) {
  Vehicle v = testing::flown_quad();
  v.command = CommandRange{1100.0, 1900.0};
  Running server("ardupilot", v);
  FakeArduPilot pilot(server.port());
  for (int i = 0; i < 4; ++i) pilot.frame({1000, 1300, 1500, 2000});
  const FlightLog& log = server.end().log;
  // Outputs 1 to 4 drive rotors 4, 1, 2, 3.
  EXPECT_EQ(log.delta[3][0], 0.0);
  EXPECT_EQ(log.delta[0][0], 0.25);
  EXPECT_EQ(log.delta[1][0], 0.5);
  EXPECT_EQ(log.delta[2][0], 1.0);
}

TEST(Serve, APortThatIsTakenIsNamed) {
  const UdpSocket first("127.0.0.1", 0);
  try {
    const UdpSocket second("127.0.0.1", first.port());
    FAIL();
  } catch (const UsageError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("port " + std::to_string(first.port()) + " of 127.0.0.1 is taken"), std::string::npos)
        << text;
  }
  EXPECT_THROW(UdpSocket("not.an.address", 0), UsageError);
}

TEST(Serve, EndsAfterTheSecondsAskedFor) {
  Running server("ardupilot", testing::flown_quad(), {.seconds = 0.1});
  FakeArduPilot pilot(server.port());
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(pilot.frame({1000, 1000, 1000, 1000}).is_object()) << i;
  EXPECT_EQ(pilot.exchange(testing::servo_packet(400, 40, {}), 0.2), "");
}

/// Betaflight SITL in small: each state that comes is answered by motors.
class FakeBetaflight {
 public:
  FakeBetaflight() : socket_("127.0.0.1", 0) {}
  std::uint16_t state_port() const { return socket_.port(); }
  void find(std::uint16_t port) { server_.port = port; }

  testing::Attitude fly(const testing::Wish& wish, double seconds) {
    const double until = now_ + seconds;
    while (now_ < until) {
      const std::optional<Datagram> state = socket_.receive(2.0);
      if (!state) break;
      view = testing::received(state->bytes, testing::BetaflightBuild::released);
      now_ = view.timestamp;
      seen_ = testing::pilots_view(view);
      ++states;
      socket_.send(server_,
                   testing::motor_packet(testing::betaflight_motors(testing::controlled(seen_, wish)),
                                         testing::BetaflightBuild::released));
    }
    return seen_;
  }
  testing::BetaflightView view{};
  int states = 0;

 private:
  UdpSocket socket_;
  Endpoint server_{ipv4_address("127.0.0.1"), 0};
  testing::Attitude seen_;
  double now_ = 0.0;
};

TEST(Serve, BetaflightIsFlownAgainstTheClock) {
  FakeBetaflight pilot;
  const auto start = std::chrono::steady_clock::now();
  Running server("betaflight", testing::flown_quad(), {.state_port = pilot.state_port(), .rate = 500});
  pilot.find(server.port());
  pilot.fly({.climb = 1.5}, 2.5);
  EXPECT_GT(pilot.view.up - 488, 1.0);
  EXPECT_GT(pilot.fly({.roll = 0.2}, 1).roll, 0.1);
  EXPECT_LT(pilot.fly({.pitch = -0.2}, 1).pitch, -0.1);
  const double before = pilot.fly({}, 0.3).yaw;
  EXPECT_GT(pilot.fly({.yaw_rate = 0.6}, 1.2).yaw - before, 0.2);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GT(seconds, 5.5);
  EXPECT_GT(pilot.states, 2000);
  const Served& served = server.end();
  EXPECT_GT(served.frames, 2000U);
  EXPECT_NEAR(served.log.t[1] - served.log.t[0], 2e-3, 1e-12);
}

TEST(Serve, MotorsStopWhenBetaflightFallsSilent) {
  FakeBetaflight pilot;
  Running server("betaflight", testing::flown_quad(), {.state_port = pilot.state_port(), .rate = 200});
  pilot.find(server.port());
  pilot.fly({.climb = 1.0}, 0.5);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  const Served& served = server.end();
  EXPECT_EQ(served.log.delta[0].back(), 0.0);
}

}  // namespace
}  // namespace ident
