// Values of both sides with their deviations, and the difference with its interval.
#include "ident/gap/comparison/comparison_views.h"

#include <algorithm>

#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/effects/all_parameters.h"
#include "ident/result/json_number.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

std::array<double, 2> interval(const ComparedConstant& c) {
  const double half = normal_quantile(0.975) * c.std;
  return {c.difference - half, c.difference + half};
}

Json to_json(const ComparedCause& cause, const ComparedConstant& c) {
  const auto [low, high] = interval(c);
  return {{"name", c.name},
          {"cause", cause.name},
          {"real", {{"value", number_or_null(c.real)}, {"std", number_or_null(c.real_std)}}},
          {"simulated", {{"value", number_or_null(c.simulated)}, {"std", number_or_null(c.simulated_std)}}},
          {"difference", number_or_null(c.difference)},
          {"ci95", {number_or_null(low), number_or_null(high)}},
          {"unit", parameter_unit(c.name)},
          {"p", number_or_null(cause.p)}};
}

}  // namespace

Json differences_json(const std::vector<ComparedCause>& causes, bool all) {
  Json out = Json::array();
  for (const ComparedCause& cause : causes)
    if (all || cause.differs)
      for (const ComparedConstant& c : cause.constants) out.push_back(to_json(cause, c));
  return out;
}

Section comparison_section(const std::vector<ComparedCause>& causes) {
  std::vector<ComparedCause> ordered = causes;
  std::ranges::stable_partition(ordered, [](const ComparedCause& c) { return c.differs; });
  Table table{.title = "Real and simulated flight, constant by constant",
              .columns = {"constant", "real", "simulated", "difference", "95 % interval", "unit", "differs"}};
  for (const ComparedCause& cause : ordered)
    for (const ComparedConstant& c : cause.constants)
      table.rows.push_back({c.name, format_with_uncertainty(c.real, c.real_std),
                            format_with_uncertainty(c.simulated, c.simulated_std),
                            format_rounded(c.difference, c.std),
                            format_interval(interval(c), c.difference, c.std), parameter_unit(c.name),
                            cause.differs ? "yes" : "no"});
  return {.title = "Real against simulated",
          .text =
              "Both logs were fitted with the same causes. A constant of a cause differs where its two "
              "sizes do, with the deviations of both. The difference of a constant that was stated with "
              "a deviation is that of the two vehicles if only the constants marked here differ: it can "
              "exceed that of the two estimates, which the statement holds together.",
          .tables = {std::move(table)}};
}

}  // namespace ident
