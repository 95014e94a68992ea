// What a refinement shows besides numbers: residuals, profiles of weak constants, traces of held-out flight.
#include <gtest/gtest.h>

#include <cmath>

#include "ident/flight/fit/held_out_validation.h"
#include "ident/flight/make_record.h"
#include "ident/flight/record/excerpts.h"
#include "ident/flight/refine.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/sim/simulate.h"
#include "ident/views/flight_residuals.h"
#include "ident/views/prediction_traces.h"
#include "ident/views/profile_likelihood.h"

namespace ident {
namespace {

/// A short flight of a published vehicle, fitted with Jxx free about its true value and kT about a wrong one.
struct Fitted {
  Vehicle vehicle = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  std::vector<double> p = parameter_vector(vehicle);
  FlightRecord record;
  std::unique_ptr<Theta> theta;
  FlightFit fit;

  Fitted() {
    SimulationOptions options;
    options.duration = 15.0, options.rate = 100.0;
    const std::vector<FlightLog> logs{simulate_flight(vehicle, options).log};
    record = make_flight_record(vehicle, p, logs);
    const double kT = p[param::kT], Jxx = p[param::Jxx];
    const std::vector<FreeConstant> constants{{.name = "kT",
                                               .index = param::kT,
                                               .positive = true,
                                               .start = 1.03 * kT,
                                               .prior_std = 0.1 * kT,
                                               .prior_value = kT},
                                              {.name = "Jxx",
                                               .index = param::Jxx,
                                               .positive = true,
                                               .start = Jxx,
                                               .prior_std = 0.1 * Jxx,
                                               .prior_value = Jxx}};
    theta = std::make_unique<Theta>(p, constants, 1, true);
    fit = fit_flight(record, *theta);
  }
};

TEST(FlightProfile, OfADeterminedConstantFollowsItsCurvatureAndIsLeastAtTheEstimate) {
  const Fitted f;
  for (const int constant : {0, 1}) {
    const Profile profile = profile_of(*f.fit.smoother, f.fit, *f.theta, constant);
    ASSERT_EQ(profile.fall.size(), 7U);
    EXPECT_EQ(profile.fall[3], 0.0);
    for (std::size_t k = 0; k < 7; ++k) {
      const double z = static_cast<double>(k) - 3;
      EXPECT_NEAR(profile.fall[k], z * z, 0.1 + 0.1 * z * z) << f.theta->name(constant) << " at " << z;
    }
    EXPECT_LT(profile.value.front(), profile.value.back());
  }
}

TEST(FlightProfile, IsDrawnForUnidentifiableConstantsOnly) {
  const Fitted f;
  std::vector<Parameter> parameters = flight_parameters(*f.theta, f.fit, "flightlog");
  ASSERT_TRUE(parameters[0].identifiable && parameters[1].identifiable);
  EXPECT_TRUE(weak_constants(f.fit, parameters).empty());
  EXPECT_TRUE(profile_sections(f.fit, *f.theta, parameters, 3).empty());
  parameters[1].identifiable = false;
  const std::vector<Section> sections = profile_sections(f.fit, *f.theta, parameters, 3);
  ASSERT_EQ(sections.size(), 1U);
  ASSERT_EQ(sections[0].plots.size(), 1U);
  EXPECT_EQ(sections[0].plots[0].x_label, "Jxx [kg m^2]");
}

TEST(FlightResiduals, OfATrueModelAreWhiteAndOfTheSizeOfTheNoise) {
  const Fitted f;
  const Section section = flight_residuals(f.record, f.fit);
  const auto& rows = section.tables.at(0).rows;
  ASSERT_GE(rows.size(), 15U) << "rates, force, attitude, velocity and position were logged";
  for (const auto& row : rows) EXPECT_NEAR(std::stod(row.at(1)), 1.0, 0.08) << row.at(0);
  const double bound = std::stod(rows.at(0).at(4));
  for (std::size_t c = 0; c < 6; ++c)
    EXPECT_LT(std::abs(std::stod(rows.at(c).at(3))), 3 * bound) << rows.at(c).at(0);
  EXPECT_EQ(section.plots.size() % 5, 0U) << "five pictures a sensor";
  for (const Plot& plot : section.plots) {
    EXPECT_FALSE(plot.series.empty()) << plot.title;
    EXPECT_NE(plot.y_label.find('['), std::string::npos) << plot.title << " has no unit";
  }
}

TEST(HeldOutTraces, FollowTheMeasurementWithTheTrueModelAndLeaveItWithAWrongThrust) {
  const Fitted f;
  const FlightRecord held_out = held_out_of(f.record, 0.5);
  const Eigen::VectorXd wrong = Eigen::VectorXd::Zero(f.theta->size());  // kT three percent too high
  PredictionOptions options;
  options.horizons = {0.5};
  const auto before = predict_windows(held_out, *f.theta, wrong, f.fit.noise, options);
  const auto after = predict_windows(held_out, *f.theta, f.fit.u, f.fit.noise, options);
  const std::vector<int> channels = channels_that_gain(before[0], after[0]);
  ASSERT_FALSE(channels.empty());
  // Thrust acts along z and, through the slanted rotors, about it.
  EXPECT_TRUE(channels[0] % 3 == 2) << "not in " << channel_name(channels[0]);
  const std::vector<Plot> plots =
      prediction_traces(held_out, {"given", f.theta.get(), wrong}, {"found", f.theta.get(), f.fit.u},
                        f.fit.noise, {kVelocity + 2}, {0.5});
  ASSERT_EQ(plots.size(), 1U);
  ASSERT_EQ(plots[0].series.size(), 3U);
  const auto rms = [&](const Series& predicted) {
    const Series& measured = plots[0].series[0];
    double sum = 0, n = 0;
    for (std::size_t i = 0; i < predicted.x.size(); ++i)
      for (std::size_t k = 0; k < measured.x.size(); ++k)
        if (measured.x[k] == predicted.x[i] && std::isfinite(predicted.y[i]))
          sum += std::pow(predicted.y[i] - measured.y[k], 2), n += 1;
    EXPECT_GT(n, 100);
    return std::sqrt(sum / n);
  };
  EXPECT_LT(rms(plots[0].series[2]), 0.5 * rms(plots[0].series[1]));
}

TEST(HeldOutTraces, EndWhereTheFlightIsCut) {
  const Fitted f;
  FlightRecord cut = f.record;
  const FlightArc whole = cut.arcs[0];
  const std::size_t rows = whole.rows();
  cut.arcs = {whole.piece(0, rows / 3), whole.piece(2 * rows / 3, rows)};
  const std::vector<Plot> plots =
      prediction_traces(cut, {"given", f.theta.get(), f.fit.u}, {"found", f.theta.get(), f.fit.u},
                        f.fit.noise, {kVelocity + 2}, {0.5});
  ASSERT_EQ(plots.size(), 1U);
  const Series& measured = plots[0].series[0];
  const auto gap = std::ranges::find_if(measured.y, [](double y) { return std::isnan(y); });
  ASSERT_NE(gap, measured.y.end());
  const double t = measured.x[static_cast<std::size_t>(gap - measured.y.begin())];
  EXPECT_GT(t, whole.t[rows / 3 - 1]);
  EXPECT_LT(t, whole.t[2 * rows / 3]);
}

TEST(Validation, SaysWhereTheStatedConstantsPredictBetterAndOnlyThere) {
  const Fitted f;
  const FlightRecord held_out = held_out_of(f.record, 0.5);
  const Eigen::VectorXd wrong = Eigen::VectorXd::Zero(f.theta->size());  // kT three percent too high
  const Validation good = validate_refined(held_out, *f.theta, wrong, f.fit);
  EXPECT_FALSE(good.worse);
  ASSERT_EQ(good.horizons.size(), 3U);
  for (const HorizonErrors& h : good.horizons) EXPECT_LT(h.refined.error, h.stated.error) << h.horizon;
  FlightFit turned = f.fit;
  turned.u = wrong;
  const Validation bad = validate_refined(held_out, *f.theta, f.fit.u, turned);
  EXPECT_TRUE(bad.worse);
  const Validation same = validate_refined(held_out, *f.theta, f.fit.u, f.fit);
  EXPECT_FALSE(same.worse) << "as well as stated is not worse";
}

}  // namespace
}  // namespace ident
