// The list of simulators' formats against their files, and how a format is chosen by content.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "ident/core/error.h"
#include "ident/io/simulators/patch.h"
#include "ident/io/simulators/simulators.h"

namespace ident {
namespace {

TEST(SimulatorFormats, EachIsOneFileAndOneLine) {
  std::set<std::string> listed, written;
  for (const SimulatorFormat& format : simulator_formats()) {
    std::string name(format.target);
    std::ranges::replace(name, '-', '_');
    listed.insert(name);
  }
  for (const auto& entry : std::filesystem::directory_iterator(std::string(IDENT_SOURCE_DIR) +
                                                               "/src/ident/io/simulators/formats"))
    written.insert(entry.path().stem().string());
  EXPECT_EQ(listed, written);
}

TEST(SimulatorFormats, AVehicleFileIsNone) {
  EXPECT_EQ(recognised_simulator("mass: 0.5\nlayout: x\narm: 0.17\nparameters:\n  kT: 6e-6\n"), nullptr);
  EXPECT_EQ(recognised_simulator(""), nullptr);
  EXPECT_EQ(recognised_simulator("# SIH_MASS 1.0 would be that of PX4\nmass: 1.0\n"), nullptr);
}

TEST(SimulatorFormats, AMistypedTargetIsToldWithTheNearestName) {
  try {
    find_simulator("rotropy");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'rotorpy'?"), std::string::npos) << error.what();
  }
}

TEST(SimulatorFormats, AFileOfAnotherFormatIsNotPatched) {
  const Vehicle vehicle;
  EXPECT_THROW(patch_simulator(find_simulator("gz"), "quad_params = {}", "q.py", vehicle), InputError);
  EXPECT_THROW(patch_simulator(find_simulator("c99"), "", "model.h", vehicle), UsageError);
}

}  // namespace
}  // namespace ident
