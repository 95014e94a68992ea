// Named layouts: places, spins and axes as the file format describes them.
#include "ident/model/vehicle.h"

#include <gtest/gtest.h>

namespace ident {
namespace {

TEST(Vehicle, SlantedRotorsPointAsInPhang14) {
  const double a = 0.1;
  const auto rotors = layout_rotors("4sp", 0.2, a);
  EXPECT_TRUE(rotors[1].a_B.isApprox(Eigen::Vector3d(-std::sin(a), 0, -std::cos(a))));
  EXPECT_TRUE(rotors[3].a_B.isApprox(Eigen::Vector3d(std::sin(a), 0, -std::cos(a))));
  for (const Rotor& rotor : rotors) EXPECT_EQ(rotor.s, 1);
}

TEST(Vehicle, SpinsOfConventionalLayoutsCancelInPairs) {
  for (const char* layout : {"plus", "x"}) {
    int sum = 0;
    for (const Rotor& rotor : layout_rotors(layout, 0.2, 0)) sum += rotor.s;
    EXPECT_EQ(sum, 0) << layout;
  }
}

}  // namespace
}  // namespace ident
