// `ident fly` as a user runs it: help, messages, a flight by a small ArduPilot, the log, Ctrl-C.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <thread>

#include "support/fake_autopilot.h"
#include "support/flown_vehicle.h"
#include "support/run_program.h"

namespace ident {
namespace {

constexpr const char* kVehicle = R"(name: flown
mass: 0.8
layout: x
arm: 0.2
command: {min: 1000, max: 2000}
parameters: {kT: 7.848e-6, kQ: 1.25e-7, km: 1000, omega_m: 45, zeta_m: 0.9, dead_time: 0.003, Jxx: 6e-3, Jyy: 6.5e-3,
  Jzz: 1.1e-2, Jp: 2e-5}
)";

std::uint16_t free_port() { return UdpSocket("127.0.0.1", 0).port(); }

TEST(FlyProgram, HelpLeadsWithExamplesAndNamesTheAutopilots) {
  const ProgramRun run = run_ident({"fly", "--help"});
  EXPECT_EQ(run.status, 0);
  for (const char* text :
       {"ident fly ardupilot --vehicle falcon.yaml", "sim_vehicle.py", "betaflight", "--order", "--legs"})
    EXPECT_NE(run.out.find(text), std::string::npos) << text << "\n" << run.out;
}

TEST(FlyProgram, APortThatIsTakenEndsItBeforeAnythingStarts) {
  const std::string folder = test_folder();
  write_text(folder, "v.yaml", kVehicle);
  const UdpSocket taken("127.0.0.1", 0);
  const ProgramRun run =
      run_ident({"fly", "ardupilot", "--vehicle", "v.yaml", "--port", std::to_string(taken.port())}, folder);
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("is taken: another program listens there"), std::string::npos) << run.err;
}

TEST(FlyProgram, OptionsOfTheOtherAutopilotAreRefused) {
  const std::string folder = test_folder();
  write_text(folder, "v.yaml", kVehicle);
  const ProgramRun rate = run_ident({"fly", "ardupilot", "--vehicle", "v.yaml", "--rate", "500"}, folder);
  EXPECT_EQ(rate.status, 2);
  EXPECT_NE(rate.err.find("no --rate"), std::string::npos) << rate.err;
  const ProgramRun build =
      run_ident({"fly", "betaflight", "--vehicle", "v.yaml", "--build", "gazbo"}, folder);
  EXPECT_EQ(build.status, 2);
  EXPECT_NE(build.err.find("did you mean 'gazebo'"), std::string::npos) << build.err;
}

TEST(FlyProgram, WritesWhatWasFlownAsALogThatItReadsAgain) {
  const std::string folder = test_folder();
  write_text(folder, "v.yaml", kVehicle);
  const std::uint16_t port = free_port();
  ProgramRun run;
  std::thread program([&] {
    run = run_ident({"fly", "ardupilot", "--vehicle", "v.yaml", "--port", std::to_string(port), "--seconds",
                     "4", "--log", "flown.csv"},
                    folder);
  });
  testing::FakeArduPilot pilot(port);
  const std::string first = testing::servo_packet(400, 0, {1000, 1000, 1000, 1000});
  for (int i = 0; i < 100 && pilot.exchange(first, 0.1).empty(); ++i) {
  }
  pilot.exchange("garbage", 0.01);
  pilot.count = 1;
  pilot.fly({.climb = 1.0}, 1.9975);
  for (const double roll : {0.2, -0.2, 0.2, -0.2}) pilot.fly({.roll = roll, .pitch = 0.5 * roll}, 0.5);
  program.join();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("4.00 s flown with ardupilot in 1600 frames"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("1600 rows in flown.csv"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("1 x 7 bytes, too few for a servo packet"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("FRAME_CLASS 1 (quad), FRAME_TYPE 1"), std::string::npos) << run.err;
  const ProgramRun read = run_ident({"flightlog", "flown.csv", "--vehicle", "v.yaml"}, folder);
  EXPECT_EQ(read.status, 0) << read.out << read.err;
}

TEST(FlyProgram, CtrlCEndsItWithAWord) {
  const std::string folder = test_folder();
  write_text(folder, "v.yaml", kVehicle);
  const std::string command = "cd '" + folder +
                              "' && timeout --preserve-status -s INT 1 '" IDENT_PROGRAM
                              "' fly ardupilot --vehicle v.yaml --port 0 >out 2>err";
  const int ended = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(ended), 1);
  EXPECT_EQ(std::system(("grep -q 'No command of ardupilot arrived' '" + folder + "/out'").c_str()), 0);
}

}  // namespace
}  // namespace ident
