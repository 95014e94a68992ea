// Result of `ident inertia`: parameters, physical check, tables and pictures.
#include "ident/bench/inertia/trifilar_inertia.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ident/bench/inertia/trifilar_inertia_fit.h"
#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_result.h"
#include "ident/plots/residual_plots.h"

namespace ident {
namespace {

constexpr double kLargestPlatform = 1.6, kLargestVehicle = 3.0;  // radius of gyration over that of the wires
constexpr std::array kVehicleAxes = {PendulumAxis::x, PendulumAxis::y, PendulumAxis::z};

/// Each moment is at most the sum of the two others: J_a + J_b - J_c = 2 integral(c^2 dm) >= 0.
void check_triangle(Result& result, const LeastSquaresFit& fit) {
  const std::array names = {"Jxx", "Jyy", "Jzz"};
  for (const char* name : names)
    if (!result.find(name)) return;
  auto checks = nlohmann::ordered_json::array();
  for (std::size_t c = 0; c < 3; ++c) {
    const char *a = names[(c + 1) % 3], *b = names[(c + 2) % 3];
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(fit.x.size());
    gradient(fit.index(a)) = gradient(fit.index(b)) = 1.0;
    gradient(fit.index(names[c])) = -1.0;
    const double margin = gradient.dot(fit.x), std = fit.std_of(gradient);
    const bool noise_known = std > 0.0 && std::isfinite(std);
    const double probability = noise_known     ? t_cdf(margin / std, fit.dof_of(gradient))
                               : margin >= 0.0 ? 1.0
                                               : 0.0;
    const std::string sides = fmt::format("{} + {} - {}", a, b, names[c]);
    checks.push_back(
        {{"margin", sides}, {"value", margin}, {"std", std}, {"probability_physical", probability}});
    if (margin < 0.0)
      result.warn(
          "triangle_inequality",
          fmt::format("{} = {} kg m^2 is negative: no body has these moments (probability that the true "
                      "ones are possible: {:.3g}). Check axis, radius, length, and the platform's rows.",
                      sides, format_with_uncertainty(margin, std), probability));
  }
  result.extra["triangle"] = checks;
}

/// One period for each axis and nothing that states its error: values without deviations.
void without_noise(Result& result) {
  for (Parameter& p : result.parameters) {
    p.std = kNaN;
    p.ci95 = {kNaN, kNaN};
    p.naive_std.reset();
    p.identifiable = false;
    p.note = "no row is repeated and none states a std: the error of a period is unknown";
  }
  result.warn("no_repeats",
              "no row is repeated and there is no column `std`: values have no uncertainty. Time every axis "
              "several times, or state the standard deviation of a period.");
}

void add_warnings(Result& result, const PendulumModel& model, const LeastSquaresFit& fit) {
  if (!model.has_axis(PendulumAxis::platform))
    result.warn("no_platform",
                "no rows of the empty platform: the vehicle is taken to hang on the wires alone. Time the "
                "empty platform, unless there is none.");
  for (const PendulumAxis axis : kVehicleAxes)
    if (!model.has_axis(axis))
      result.warn("axis_missing",
                  fmt::format("no rows for {}: it is not measured. Swing the vehicle about that axis.",
                              PendulumModel::name(axis)));
  for (std::size_t i = 0; i < fit.rejected.size(); ++i)
    if (const PendulumRow& row = model.rows()[i]; fit.rejected[i])
      result.warn("outlier",
                  fmt::format("{}:{}: period {:.4f} s lies {:.1f} standard deviations off the other "
                              "rows of its axis and is left out",
                              row.file, row.line, row.period,
                              std::fabs(fit.residuals(static_cast<Eigen::Index>(i))) /
                                  fit.residual_sigma(static_cast<Eigen::Index>(i))));
  for (const Parameter& p : result.parameters)
    if (p.value <= 0.0)
      result.warn("negative_inertia",
                  fmt::format("{} = {} kg m^2: the platform's period or mass does not fit to "
                              "that of the loaded pendulum",
                              p.name, format_with_uncertainty(p.value, p.std)));
}

/// Radii of gyration over the wires' radius: bodies that hang on the wires are about as large as their
/// circle.
void check_size(Result& result, const PendulumModel& model, const LeastSquaresFit& fit) {
  double radius = 0.0, length = 0.0;
  for (const PendulumRow& row : model.rows())
    radius = std::max(radius, row.radius), length = std::max(length, row.length);
  const auto too_large = [&](const std::string& name, double mass, double most) {
    const double ratio = std::sqrt(std::max(fit.value(name), 0.0) / mass) / radius;
    if (ratio < most) return;
    result.warn(
        "implausible_inertia",
        fmt::format(
            "{} = {} kg m^2 is that of {:.2g} kg at {:.2g} times the radius of the wires: is `period` that "
            "of one oscillation, in seconds, and are radius ({} m) and length ({} m) in their columns?",
            name, format_number(fit.value(name), 3), mass, ratio, format_number(radius, 3),
            format_number(length, 3)));
  };
  if (model.has_axis(PendulumAxis::platform))
    too_large("J_platform", model.platform_mass(), kLargestPlatform);
  for (const PendulumAxis axis : kVehicleAxes)
    for (const PendulumRow& row : model.rows())
      if (row.axis == axis) {
        too_large(PendulumModel::name(axis), row.mass - model.platform_mass(), kLargestVehicle);
        break;
      }
}

/// Residuals of the periods in seconds, whatever they were weighted with.
std::vector<double> period_residuals(const PendulumModel& model, const LeastSquaresFit& fit) {
  std::vector<double> residual;
  for (const PendulumRow& row : model.rows())
    residual.push_back(row.period -
                       trifilar_period(model.suspension(row), model.hanging_inertia(row, fit.x)).period);
  return residual;
}

Section section(const PendulumModel& model, const LeastSquaresFit& fit, const std::vector<double>& residual) {
  Table table{
      .title = "Swings",
      .columns = {"axis", "rows", "mean period [s]", "scatter [s]", "left out", "J hanging [kg m^2]"}};
  Series measured{.name = "period measured", .style = Series::Style::points};
  Series fitted{.name = "period predicted", .style = Series::Style::line};
  std::vector<double> number;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    number.push_back(static_cast<double>(i + 1));
    measured.y.push_back(model.rows()[i].period);
    fitted.y.push_back(model.rows()[i].period - residual[i]);
  }
  measured.x = fitted.x = number;
  for (const PendulumAxis axis :
       {PendulumAxis::x, PendulumAxis::y, PendulumAxis::z, PendulumAxis::platform}) {
    std::vector<double> periods, spread;
    std::size_t out = 0;
    double J = kNaN;
    for (std::size_t i = 0; i < residual.size(); ++i) {
      if (model.rows()[i].axis != axis) continue;
      J = model.hanging_inertia(model.rows()[i], fit.x);
      if (fit.rejected[i]) {
        ++out;
        continue;
      }
      periods.push_back(model.rows()[i].period);
      spread.push_back(residual[i]);
    }
    if (std::isfinite(J))
      table.rows.push_back({PendulumModel::name(axis), fmt::format("{}", model.count(axis)),
                            format_number(mean(periods), 6), format_number(standard_deviation(spread), 2),
                            fmt::format("{}", out), format_number(J, 5)});
  }
  const ResidualNames names{.id = "inertia-period", .channel = "period", .unit = "s"};
  std::vector<Plot> plots;
  plots.push_back({.id = "inertia-periods",
                   .title = "Periods of the trifilar pendulum",
                   .caption = "Rows sorted by axis.",
                   .x_label = "row",
                   .y_label = "period [s]",
                   .series = {std::move(measured), std::move(fitted)}});
  plots.push_back(residual_plot(names, number, "row", residual, fit.rejected));
  const std::vector<double> standardized(fit.standardized.begin(), fit.standardized.end());
  if (residual.size() >= 8) plots.push_back(normal_quantile_plot(names, standardized));
  return {
      .title = "Trifilar pendulum",
      .text =
          "J = m g (radius^2 - c^2) period^2/(4 pi^2 length), less the platform and the offset of the centre "
          "of gravity; where an amplitude is given, the exact period at that amplitude is used. The "
          "intervals hold the error of the periods only: an error of the radius counts twice, one of length "
          "or mass once, relative to the hanging inertia.",
      .tables = {table},
      .plots = plots};
}

}  // namespace

Result estimate_inertia(const std::vector<NumberTable>& tables, const InertiaOptions& options) {
  Result result{.command = "inertia"};
  for (const NumberTable& table : tables) {
    result.inputs.push_back(table.file);
    result.warnings.insert(result.warnings.end(), table.warnings.begin(), table.warnings.end());
  }
  const PendulumModel model(pendulum_rows(tables), options.gravity);
  if (std::ranges::none_of(kVehicleAxes, [&](PendulumAxis a) { return model.has_axis(a); }))
    throw DataError("no row has axis x, y or z: there is only the empty platform");

  const LeastSquaresFit fit = model.fit(result.warnings);
  for (const PendulumAxis axis : kVehicleAxes)
    if (model.has_axis(axis))
      result.parameters.push_back(fitted_parameter(fit, PendulumModel::name(axis), "kg m^2", "inertia"));
  check_triangle(result, fit);
  add_warnings(result, model, fit);
  check_size(result, model, fit);
  const bool noise_known =
      fit.degrees_of_freedom > 0.0 ||
      std::ranges::all_of(model.rows(), [](const PendulumRow& r) { return r.std > 0.0; });
  if (!noise_known) without_noise(result);
  // The platform's own inertia is taken off all of them.
  std::vector<std::string> moments;
  for (const Parameter& p : result.parameters) moments.push_back(p.name);
  if (noise_known && moments.size() > 1) result.correlation = fitted_correlation(fit, moments);

  const std::vector<double> residual = period_residuals(model, fit);
  std::vector<double> kept, periods;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    if (fit.rejected[i]) continue;
    kept.push_back(residual[i]);
    periods.push_back(model.rows()[i].period);
  }
  result.fit = {{"samples", residual.size()},
                {"rejected", residual.size() - kept.size()},
                {"r2", r_squared(periods, kept)},
                {"rmse", {{"period", root_mean_square(kept)}}},
                {"degrees_of_freedom", fit.degrees_of_freedom}};
  if (model.has_axis(PendulumAxis::platform))
    result.extra["platform"] = {{"J", fit.value("J_platform")},
                                {"std", noise_known ? fit.std("J_platform") : kNaN},
                                {"mass", model.platform_mass()}};
  result.sections.push_back(section(model, fit, residual));
  return result;
}

Parameter propeller_inertia(double mass, double chord, double length) {
  if (!(mass > 0.0) || !(chord > 0.0) || !(length > 0.0))
    throw UsageError("mass, chord and length of a propeller must be positive");
  return {.name = "Jp",
          .value = mass * (chord * chord + length * length) / 12.0,
          .unit = "kg m^2",
          .source = "inertia",
          .note = "of the propeller alone, as a rectangular plate; the motor's rotating parts add to it"};
}

}  // namespace ident
