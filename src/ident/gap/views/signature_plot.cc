// Draws signatures, and writes them into the JSON without their points.
#include "ident/gap/views/signature_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/gap/views/gap_pictures.h"
#include "ident/result/json_number.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;
using Style = Series::Style;

std::string with_unit(double value, double std, const std::string& unit) {
  return format_with_uncertainty(value, std) + (unit == "-" ? "" : " " + unit);
}

std::string caption_of(const Signature& s) {
  const std::string tightness = fmt::format("correlation {:.3f}", s.correlation);
  if (s.parameter.empty())
    return fmt::format("A line through these points has the slope {}, where 1 is the size found; {}.",
                       format_with_uncertainty(s.slope, s.slope_std), tightness);
  return fmt::format("A line through these points gives {}, the fit to all data {}; {}.",
                     with_unit(s.slope, s.slope_std, s.parameter_unit),
                     with_unit(s.found, s.found_std, s.parameter_unit), tightness);
}

Plot scatter(const Signature& s) {
  const std::string unit = channel_unit(s.channel);
  const double low = std::ranges::min(s.x), high = std::ranges::max(s.x);
  const std::vector<double> ends{low, high};
  const auto line = [&](double slope, double offset) {
    return std::vector<double>{slope * low + offset, slope * high + offset};
  };
  const std::string per_unit =
      s.parameter_unit == "-" || s.parameter.empty() ? unit : unit + " per " + s.parameter_unit;
  return {.id = fmt::format("signature-{}-{}", s.cause, s.channel),
          .title = fmt::format("Signature of {} in {}", s.cause, s.channel),
          .caption = caption_of(s),
          .x_label = s.parameter.empty()
                         ? fmt::format("{} as {} predicts it [{}]", s.channel, s.cause, unit)
                         : fmt::format("{} per unit of {} [{}]", s.channel, s.parameter, per_unit),
          .y_label = fmt::format("{} that the model lacks [{}]", s.channel, unit),
          .series = {{.name = "3 sigma of the sensors",
                      .x = ends,
                      .y = line(s.found, -3 * s.noise),
                      .y2 = line(s.found, 3 * s.noise),
                      .style = Style::band},
                     {.name = "flight", .x = s.x, .y = s.y, .style = Style::points},
                     {.name = "fitted to these points", .x = ends, .y = line(s.slope, 0)}}};
}

}  // namespace

Json to_json(const std::vector<Signature>& signatures) {
  Json out = Json::array();
  for (const Signature& s : signatures)
    out.push_back({{"cause", s.cause},
                   {"channel", s.channel},
                   {"parameter", s.parameter.empty() ? Json(nullptr) : Json(s.parameter)},
                   {"found", number_or_null(s.found)},
                   {"found_std", number_or_null(s.found_std)},
                   {"slope", number_or_null(s.slope)},
                   {"correlation", number_or_null(s.correlation)},
                   {"points", s.x.size()}});
  return out;
}

std::vector<Section> signature_sections(const std::vector<Signature>& signatures) {
  if (signatures.empty()) return {};
  Section section{
      .title = "The signature against the flight",
      .text =
          "One point for each piece of flight. Up: the force or moment that the model lacks when this "
          "cause alone is taken out of it. Right: what the cause predicts there, from the same state. "
          "A true cause puts the points on one straight line through zero."};
  for (const Signature& s : signatures) section.plots.push_back(scatter(s));
  return {section};
}

}  // namespace ident
