// Files are known by what they hold, whatever they are called.
#include "ident/io/campaign/recognise_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "ident/core/error.h"
#include "support/run_program.h"

namespace ident {
namespace {

FileKind kind_of(const std::string& content) {
  return recognise_file(write_text(test_folder(), "file", content)).kind;
}

std::string reason(const std::string& content) {
  const FoundFile found = recognise_file(write_text(test_folder(), "file", content));
  EXPECT_EQ(found.kind, FileKind::other) << content;
  return found.what;
}

TEST(RecogniseFile, BenchFilesByTheirColumns) {
  EXPECT_EQ(kind_of("omega,thrust\n100,0.1\n200,0.4\n"), FileKind::thrust);
  EXPECT_EQ(kind_of("t,delta,rpm\n0,0.5,3000\n0.01,0.5,3010\n"), FileKind::motor);
  EXPECT_EQ(kind_of("axis,period,mass,radius,length\nx,1.2,0.8,0.1,1.5\n"), FileKind::inertia);
}

// A stand writes time and command beside the thrust: steps are told by what is missing there.
TEST(RecogniseFile, ThrustMakesASweepOfWhatHasTimeAndCommandToo) {
  EXPECT_EQ(kind_of("Time (s);ESC signal (us);Thrust (kgf);rpm\n0;1100;0.1;2000\n1;1200;0.2;3000\n"),
            FileKind::thrust);
}

TEST(RecogniseFile, FlightLogsByWhatTheyNeed) {
  EXPECT_EQ(kind_of("t,delta1,delta2,delta3,delta4,p,q,r\n0,.5,.5,.5,.5,0,0,0\n0.01,.5,.5,.5,.5,0,0,0\n"),
            FileKind::flight_log);
  EXPECT_EQ(kind_of("t,u1,u2,u3,u4,ax,ay,az\n0,1500,1500,1500,1500,0,0,-9.8\n"), FileKind::flight_log);
  EXPECT_EQ(kind_of("t_s,motor_m1,motor_m2,gyro_x\n0,.5,.5,0.1\n0.01,.5,.5,0.1\n"), FileKind::table);
}

TEST(RecogniseFile, AutopilotLogsByTheirFirstBytes) {
  EXPECT_EQ(kind_of(std::string("\x55\x4c\x6f\x67\x01\x12\x35\x01", 8) + std::string(8, '\0')),
            FileKind::autopilot_log);
}

TEST(RecogniseFile, VehiclesParametersAndMapsByTheirKeys) {
  EXPECT_EQ(kind_of("layout: x\narm: 0.17\nmass: 0.5\n"), FileKind::vehicle);
  EXPECT_EQ(kind_of("parameters:\n  kT: {value: 6e-6, std: 1e-8}\n"), FileKind::parameters);
  EXPECT_EQ(kind_of("columns: {t: time_s, p: gyro}\n"), FileKind::map);
}

TEST(RecogniseFile, SaysWhyAFileIsLeftAlone) {
  EXPECT_NE(reason("rotors:\n  - {position: [0, 0], spin: up}\n").find("1"), std::string::npos);
  EXPECT_NE(reason("layout: x\narn: 0.17\n").find("did you mean 'arm'"), std::string::npos);
  EXPECT_NE(reason("PK\x03\x04zip").find("unpack it first"), std::string::npos);
  EXPECT_NE(reason("vehicle: a.yaml\nlogs: b.csv\n").find("a campaign file"), std::string::npos);
  EXPECT_NE(reason("{\n \"a\": {\n  \"first\": 1.5,\n  \"last\": 2.5\n }\n}\n").find("no log, bench file"),
            std::string::npos);
  EXPECT_NE(reason("# Notes\n\nFlown at noon, calm, two packs.\n").find("no log, bench file"),
            std::string::npos);
}

TEST(RecogniseFile, WhatIsHiddenAndOtherCampaignsArePassedOver) {
  const std::string folder = test_folder();
  for (const char* below : {"flights", ".ident", "other"})
    std::filesystem::create_directories(std::filesystem::path(folder) / below);
  for (const char* name :
       {"flights/b.csv", "a.csv", ".hidden.csv", ".ident/c.csv", "other/ident.yaml", "other/d.csv"})
    write_text(folder, name, "t\n0\n");
  const std::vector<std::string> files = files_of_folder(folder);
  ASSERT_EQ(files.size(), 2U);
  EXPECT_TRUE(files[0].ends_with("/a.csv")) << files[0];
  EXPECT_TRUE(files[1].ends_with("/flights/b.csv")) << files[1];
  EXPECT_THROW(files_of_folder(folder + "/nowhere"), InputError);
}

}  // namespace
}  // namespace ident
