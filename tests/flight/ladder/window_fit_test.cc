// Least squares over windows, of flight whose form the fitted constants do not have.
#include "ident/flight/ladder/window_fit.h"

#include <gtest/gtest.h>

#include "ident/flight/make_record.h"
#include "ident/flight/prepare.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using testing::flight;
using testing::quad;

// A drag in proportion to velocity that is stated wrong along each axis: none of the constants that are
// fitted undoes it, and what they miss is all of one colour. Noise estimated where the search stands, in
// place of where these constants miss least, swings from step to step, and the last one is taken.
TEST(WindowFit, EndsWhereItEndsWhereverItBegins) {
  Vehicle truth = quad(0.0);
  for (const char* name : {"Kdx", "Kdy", "Kdz"}) truth.parameters[name] = {0.06, {}};
  Vehicle stated = testing::known(truth);
  stated.parameters["kT"] = {1.2 * truth.value("kT"), 0.6 * truth.value("kT")};
  for (const char* name : {"Kdx", "Kdy", "Kdz"}) stated.parameters[name].value = 0.09;
  stated.parameters["Kdz"].value = 0.03;
  const std::vector<FlightLog> logs{flight(truth, 250, 3, 60.0)};
  std::vector<Warning> warnings;
  const FlightRecord record = make_flight_record(stated, starting_constants(stated, logs, warnings), logs);
  const MeasuredMotion motion = measured_motion(record);
  const std::vector<std::string> names{
      "m", "kT", "km", "rotor_drag.kd", "axial_inflow.kz", "translational_lift.kh", "parasitic_drag.C"};
  std::vector<FreeConstant> constants = free_constants(stated, record.p, names);
  std::erase_if(constants,
                [&](const FreeConstant& c) { return std::ranges::find(names, c.name) == names.end(); });
  ASSERT_EQ(constants.size(), names.size());
  const Theta theta(record.p, constants, record.logs, false);
  std::vector<double> elsewhere = record.p;
  for (const FreeConstant& c : constants)
    elsewhere[static_cast<std::size_t>(c.index)] = c.positive ? 1.2 * c.start : c.start + 2 * c.scale;
  const WindowFit one = fit_windows(motion, theta, FitTo::forces, {}, record.p),
                  other = fit_windows(motion, theta, FitTo::forces, {}, elsewhere);
  for (int i = 0; i < theta.size(); ++i)
    EXPECT_NEAR(one.u[i], other.u[i], 0.02 * std::sqrt(one.covariance(i, i)) + 1e-3)
        << names[static_cast<std::size_t>(i)];
}

}  // namespace
}  // namespace ident
