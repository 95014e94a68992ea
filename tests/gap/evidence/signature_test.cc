// The signature of a withheld effect against the flight: its slope is the effect's size, in the right
// channel.
#include "ident/gap/evidence/signature.h"

#include <gtest/gtest.h>

#include "ident/gap/diagnose.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/sim/simulate.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

Result diagnosed(const std::string& parameter, double size) {
  const Vehicle model = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  Vehicle truth = model;
  truth.parameters[parameter] = {size, {}};
  SimulationOptions options;
  options.duration = 25.0;
  options.rate = 100.0;
  options.seed = 2;
  const std::vector<FlightLog> logs{simulate_flight(truth, options).log};
  return diagnose_gap(model, logs).result;
}

Json signature_in(const Result& result, const std::vector<std::string>& channels) {
  for (const auto& signature : result.extra["signatures"])
    for (const std::string& channel : channels)
      if (signature["channel"] == channel) return signature;
  throw std::runtime_error("not among " + result.extra["signatures"].dump());
}

const Plot& scatter_of(const Result& result) {
  for (const Section& section : result.sections)
    for (const Plot& plot : section.plots)
      if (plot.id.starts_with("signature-")) return plot;
  throw std::runtime_error("no signature is drawn");
}

TEST(Signature, OfRotorDragIsALineInTheForceWhoseSlopeIsTheDrag) {
  constexpr double kd = 3e-5;
  const Result result = diagnosed("rotor_drag.kd", kd);
  const Json signature = signature_in(result, {"Fx", "Fy"});
  EXPECT_EQ(signature["cause"], "rotor_drag");
  EXPECT_NEAR(signature["slope"].get<double>(), kd, 0.15 * kd);
  EXPECT_GT(signature["correlation"].get<double>(), 0.8);
  const Plot& plot = scatter_of(result);
  EXPECT_NE(plot.x_label.find(" per kg/rad"), std::string::npos) << plot.x_label;
  for (const Series& series : plot.series) {
    EXPECT_LE(series.x.size(), 2000U);
    EXPECT_EQ(series.x.size(), series.y.size());
  }
}

// A centre of gravity to the right lifts the right side: a moment about x for hovering flight.
TEST(Signature, OfAnOffCentreMassIsAMomentAndItsLineHasTheSlopeOne) {
  const Result result = diagnosed("cg_offset.y", 0.004);
  const Json signature = signature_in(result, {"Mx"});
  EXPECT_EQ(signature["cause"], "cg_offset");
  EXPECT_TRUE(signature["parameter"].is_null()) << "it has three";
  EXPECT_NEAR(signature["slope"].get<double>(), 1.0, 0.15);
}

TEST(Signature, IsNotDrawnWhereNoCauseWasFound) {
  const Result result = diagnosed("rotor_drag.kd", 0.0);
  EXPECT_EQ(result.extra["verdict"]["status"], "none");
  EXPECT_TRUE(result.extra["signatures"].empty());
  EXPECT_THROW(scatter_of(result), std::runtime_error);
}

}  // namespace
}  // namespace ident
