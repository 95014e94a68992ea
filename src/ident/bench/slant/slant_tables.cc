// Tables and curves of the slant angle.
#include "ident/bench/slant/slant_tables.h"

#include <cmath>
#include <numbers>

#include "ident/bench/slant/slant_allocation.h"
#include "ident/core/format_number.h"

namespace ident {
namespace {

constexpr double kOneDegree = std::numbers::pi / 180.0;

/// What is zero but for rounding is shown as zero.
double clean(double v) { return std::fabs(v) < 1e-12 ? 0.0 : v; }

Series at_optimum(double alpha, double y) {
  return {.name = "optimum", .x = {alpha / kOneDegree}, .y = {y}, .style = Series::Style::points};
}

Plot curve(std::string id, std::string title, std::string y_label, std::vector<Series> series) {
  return {.id = std::move(id),
          .title = std::move(title),
          .x_label = "slant angle [deg]",
          .y_label = std::move(y_label),
          .series = std::move(series)};
}

}  // namespace

Table allocation_table(const Vehicle& vehicle, double alpha) {
  const Eigen::Matrix<double, 6, 4> B = input_allocation(vehicle, alpha);
  Table table{.title = "Inputs to channels, per newton of vertical thrust on each rotor",
              .columns = {"input", "Fx [N]", "Fy [N]", "Fz [N]", "Mx [N m]", "My [N m]", "Mz [N m]"}};
  for (Eigen::Index input = 0; input < 4; ++input) {
    std::vector<std::string> row = {kInputs[static_cast<std::size_t>(input)]};
    for (Eigen::Index channel = 0; channel < 6; ++channel)
      row.push_back(format_number(clean(B(channel, input)), 5));
    table.rows.push_back(std::move(row));
  }
  return table;
}

nlohmann::ordered_json allocation_json(const Vehicle& vehicle, double alpha) {
  const Eigen::Matrix<double, 6, 4> B = input_allocation(vehicle, alpha);
  nlohmann::ordered_json json;
  for (std::size_t input = 0; input < 4; ++input)
    for (std::size_t channel = 0; channel < 6; ++channel)
      json[kInputs[input]][kChannels[channel]] =
          clean(B(static_cast<Eigen::Index>(channel), static_cast<Eigen::Index>(input)));
  return json;
}

SlantPrice slant_price(const Vehicle& vehicle, double arm, double alpha) {
  const Eigen::Matrix<double, 6, 4> B = input_allocation(vehicle, alpha);
  return {.lift = 1.0 / std::cos(alpha),
          .yaw_authority = B(5, 3) / arm,
          .yaw_leak = B(5, 0) / arm,
          .sideways = B(0, 1)};
}

double mounting_trim(const Vehicle& vehicle, double arm, double alpha, double error) {
  const SlantPrice off = slant_price(vehicle, arm, alpha + error);
  return -off.yaw_leak / off.yaw_authority;
}

std::vector<Plot> slant_plots(const Vehicle& vehicle, double arm, double alpha_opt) {
  Series authority{.name = "yaw input to yaw moment"}, leak{.name = "heave input to yaw moment"},
      sideways{.name = "roll input to Fx"}, lift{.name = "lift price"}, trim{.name = "yaw trim"};
  const double last = std::max(15.0 * kOneDegree, 2.0 * alpha_opt);
  for (int i = 0; i <= 60; ++i) {
    const double alpha = last * i / 60.0;
    const SlantPrice price = slant_price(vehicle, arm, alpha);
    for (Series* s : {&authority, &leak, &sideways, &lift}) s->x.push_back(alpha / kOneDegree);
    authority.y.push_back(price.yaw_authority);
    leak.y.push_back(price.yaw_leak);
    sideways.y.push_back(price.sideways);
    lift.y.push_back(price.lift);
    const double error = (i - 30) / 10.0 * kOneDegree;
    if (alpha_opt + error < 0.5 * alpha_opt) continue;
    trim.x.push_back(error / kOneDegree);
    trim.y.push_back(100.0 * mounting_trim(vehicle, arm, alpha_opt, error));
  }
  const SlantPrice best = slant_price(vehicle, arm, alpha_opt);
  Plot mounting = curve("slant-mounting", "Cost of a mounting error",
                        "yaw input needed at hover [% of hover thrust]", {trim});
  mounting.x_label = "mounting error of the slant [deg]";
  return {curve("slant-yaw", "Yaw over the slant angle", "moment over l t [-]",
                {authority, leak, at_optimum(alpha_opt, best.yaw_authority)}),
          curve("slant-lift", "Price in lift", "thrust per vertical thrust [-]",
                {lift, at_optimum(alpha_opt, best.lift)}),
          curve("slant-sideways", "What stays coupled: sideways force of the roll input", "Fx over t [-]",
                {sideways, at_optimum(alpha_opt, best.sideways)}),
          mounting};
}

}  // namespace ident
