// Exported SDF and URDF read by the libraries of their formats, where these are installed.
#include <gtest/gtest.h>

#ifdef IDENT_HAVE_SDFORMAT
#include <sdf/sdf.hh>
#endif
#ifdef IDENT_HAVE_URDFDOM
#include <urdf_parser/urdf_parser.h>
#endif

#include "ident/io/simulators/reduced.h"
#include "ident/io/simulators/simulators.h"
#include "io/simulators/simulator_vehicles.h"

namespace ident {
namespace {

TEST(Sdformat, LoadsTheExportedModelWithTheMassesOfTheVehicle) {
#ifdef IDENT_HAVE_SDFORMAT
  for (const char* target : {"gz", "gz-classic"}) {
    const SimulatorExport made = export_to_simulator(find_simulator(target), test::plain_quadrotor());
    sdf::Root root;
    for (const sdf::Error& error : root.LoadSdfString(made.text)) ADD_FAILURE() << error.Message();
    const sdf::Model* model = root.Model();
    ASSERT_NE(model, nullptr);
    EXPECT_EQ(model->LinkCount(), 5U);
    EXPECT_EQ(model->JointCount(), 4U);
    double mass = 0;
    for (std::uint64_t i = 0; i < model->LinkCount(); ++i) {
      EXPECT_TRUE(model->LinkByIndex(i)->Inertial().MassMatrix().IsValid()) << model->LinkByIndex(i)->Name();
      mass += model->LinkByIndex(i)->Inertial().MassMatrix().Mass();
    }
    EXPECT_NEAR(mass, 0.7, 1e-12);
  }
#else
  GTEST_SKIP() << "libsdformat-dev is not installed";
#endif
}

TEST(Urdfdom, LoadsTheExportedModelWithTheMassesOfTheVehicle) {
#ifdef IDENT_HAVE_URDFDOM
  const SimulatorExport made = export_to_simulator(find_simulator("urdf"), test::plain_quadrotor());
  const auto model = urdf::parseURDF(made.text);
  ASSERT_NE(model, nullptr) << made.text;
  const auto base = model->getLink("base_link");
  ASSERT_NE(base, nullptr);
  EXPECT_EQ(model->links_.size(), 6U);
  EXPECT_NEAR(base->inertial->mass, 0.7, 1e-12);
  EXPECT_NEAR(base->inertial->izz, 5.9e-3, 1e-15);
  EXPECT_NEAR(model->getLink("prop0_link")->inertial->origin.position.x, 0.13, 1e-12);
#else
  GTEST_SKIP() << "liburdfdom-dev is not installed";
#endif
}

}  // namespace
}  // namespace ident
