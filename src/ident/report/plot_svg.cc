// Draws xy plots: bands below, then what was measured, bars, lines, dots, and predictions on top.
#include "ident/report/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "ident/core/format_number.h"
#include "ident/report/channel_colour.h"
#include "ident/report/decimate.h"
#include "ident/report/heat_map.h"
#include "ident/report/plot_frame.h"
#include "ident/report/theme.h"

namespace ident {
namespace {

using Style = Series::Style;

constexpr std::array kDrawingOrder{Style::band, Style::bars,   Style::measured,
                                   Style::line, Style::points, Style::predicted};

bool has(const Plot& plot, Style style) {
  return std::ranges::any_of(plot.series, [&](const Series& s) { return s.style == style; });
}

double second(const Series& s, std::size_t i) { return i < s.y2.size() ? s.y2[i] : kNaN; }

std::size_t length(const Series& s) { return std::min(s.x.size(), s.y.size()); }

/// Half the room that a bar has along x: to its nearest neighbour, or half a category.
double half_bar(const Series& s, bool categories) {
  if (categories || length(s) < 2) return 0.5;
  std::vector<double> x(s.x.begin(), s.x.begin() + static_cast<std::ptrdiff_t>(length(s)));
  std::ranges::sort(x);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] > x[i - 1]) nearest = std::min(nearest, x[i] - x[i - 1]);
  return std::isfinite(nearest) ? nearest / 2 : 0.5;
}

Extent extent_along(const Plot& plot) {
  Extent extent;
  for (const Series& s : plot.series)
    for (const double x : s.x) {
      if (plot.log_x && !(x > 0)) continue;
      const double half = s.style == Style::bars ? half_bar(s, false) : 0;
      extent.add(x - half), extent.add(x + half);
    }
  return extent;
}

Extent extent_across(const Plot& plot) {
  Extent extent;
  const auto add = [&](double y) {
    if (!plot.log_y || y > 0) extent.add(y);
  };
  for (const Series& s : plot.series)
    for (std::size_t i = 0; i < length(s); ++i) {
      const double y = s.y[i], y2 = second(s, i);
      if (s.style == Style::points && std::isfinite(y2)) {
        add(y - y2), add(y + y2);
      } else {
        add(y), add(y2);
      }
      if (s.style == Style::bars) add(0);
    }
  return extent;
}

PlotFrame frame_of(const Plot& plot, PlotWidth width) {
  PlotFrame frame{.along_label = plot.x_label, .across_label = plot.y_label};
  if (width == PlotWidth::half) frame.paper_width = PlotFrame::kHalfPaperWidth, frame.inner_height = 220;
  const int along_ticks = width == PlotWidth::half ? 5 : 7;
  const bool points = has(plot, Style::points), bars = has(plot, Style::bars);
  if (plot.column_names.empty()) {
    frame.along = plot.log_x ? Scale::logarithmic(extent_along(plot))
                             : Scale::linear(extent_along(plot), along_ticks,
                                             points && !bars ? Padding{0.02, 0.02} : Padding{});
  } else {
    double room = 0;
    for (const std::string& name : plot.column_names) room = std::max(room, label_width(name) + 12);
    frame.along = Scale::categories(plot.column_names);
    const auto count = static_cast<double>(plot.column_names.size());
    frame.sideways = room * count > 0.85 * PlotFrame::kPaperWidth;
    if (frame.sideways) frame.inner_height = std::max(90.0, 25 * count);
  }
  // Bars stand on zero; with names they carry their value, which wants room.
  const bool on_zero = bars && extent_across(plot).low == 0;
  const double pad = plot.column_names.empty() ? 0.05 : 0.09;
  frame.across = plot.log_y ? Scale::logarithmic(extent_across(plot))
                            : Scale::linear(extent_across(plot), 6, {.low = on_zero ? 0 : pad, .high = pad});
  return frame;
}

/// Several long lines over each other hide all but the last, unless they let it through.
bool is_dense(const Plot& plot) {
  constexpr std::size_t kLong = 400;
  return std::ranges::count_if(
             plot.series, [](const Series& s) { return s.style == Style::line && length(s) > kLong; }) > 1;
}

std::string class_of(const Plot& plot, const Series& s, int colour) {
  switch (s.style) {
    case Style::measured:  // wide and pale below what should lie on it
      return has(plot, Style::predicted) ? "measured under" : "measured";
    case Style::predicted:
      return fmt::format("predicted c{}", colour);
    case Style::points:
      return fmt::format("dots c{}", colour);
    case Style::bars:
      return fmt::format("bar c{}", colour);
    case Style::band:
      return fmt::format("band c{}", colour);
    case Style::line:
      break;
  }
  return fmt::format("line c{}{}", colour, is_dense(plot) ? " dense" : "");
}

std::vector<PaperPoint> places(const Series& s, const std::vector<double>& y, const PlotFrame& frame) {
  std::vector<PaperPoint> points;
  points.reserve(s.x.size());
  for (std::size_t i = 0; i < std::min(s.x.size(), y.size()); ++i) points.push_back(frame.at(s.x[i], y[i]));
  return points;
}

void draw_error_bars(Svg& svg, const Series& s, const PlotFrame& frame, const std::string& css_class) {
  std::string path;
  for (std::size_t i = 0; i < length(s); ++i) {
    if (!std::isfinite(second(s, i))) continue;
    const PaperPoint low = frame.at(s.x[i], s.y[i] - s.y2[i]), high = frame.at(s.x[i], s.y[i] + s.y2[i]);
    path += line_path({low, high});
  }
  svg.path(path, css_class);
}

/// Where in its room a bar stands, so that several series stand side by side unless they share no place.
struct BarSlot {
  double offset, half;  ///< along x
};

BarSlot slot_of(const Plot& plot, const Series& bars) {
  std::size_t count = 0, index = 0;
  bool overlap = false;
  std::set<double> occupied;
  for (const Series& s : plot.series) {
    if (s.style != Style::bars) continue;
    if (&s == &bars) index = count;
    ++count;
    for (std::size_t i = 0; i < length(s); ++i) {
      if (!std::isfinite(s.y[i])) continue;
      overlap = !occupied.insert(s.x[i]).second || overlap;
    }
  }
  const bool categories = !plot.column_names.empty();
  const double room = 2 * half_bar(bars, categories) * (categories ? 0.72 : 0.94);
  if (!overlap) return {0, room / 2};
  const double width = room / static_cast<double>(count);
  return {(static_cast<double>(index) + 0.5) * width - room / 2, width / 2};
}

void draw_bars(Svg& svg, const Plot& plot, const Series& s, const PlotFrame& frame,
               const std::string& css_class) {
  const BarSlot slot = slot_of(plot, s);
  const double floor = plot.log_y ? frame.across.low() : 0;
  const bool labelled = !plot.column_names.empty() && plot.column_names.size() <= 24;
  for (std::size_t i = 0; i < length(s); ++i) {
    if (!std::isfinite(s.y[i])) continue;
    const double from = std::isfinite(second(s, i)) ? second(s, i) : floor;
    const double x = s.x[i] + slot.offset;
    const PaperPoint a = frame.at(x - slot.half, from), b = frame.at(x + slot.half, s.y[i]);
    const std::string value = format_number(s.y[i] - (std::isfinite(second(s, i)) ? from : 0), 3);
    svg.rectangle({std::min(a.x, b.x), std::min(a.y, b.y)}, std::abs(b.x - a.x), std::abs(b.y - a.y),
                  css_class, "", s.name + ": " + value);
    if (!labelled) continue;
    const PaperPoint tip = frame.at(x, s.y[i]);
    if (frame.sideways) {
      const bool inside = tip.x > frame.corner.x + frame.width - label_width(value) - 8;
      svg.text({tip.x + (inside ? -5 : 5), tip.y + 4}, value, inside ? "value inside end" : "value");
    } else {
      // A floating bar carries its value inside: below it there may be no room.
      const bool inside = std::isfinite(second(s, i)) && std::abs(b.y - a.y) > 24;
      const double y = inside ? (a.y + b.y) / 2 + 4 : tip.y + (s.y[i] >= from ? -5 : 14);
      svg.text({tip.x, y}, value, inside ? "value inside middle" : "value middle");
    }
  }
}

void draw_series(Svg& svg, const Plot& plot, const Series& s, const PlotFrame& frame, int colour) {
  const std::string css_class = class_of(plot, s, colour);
  switch (s.style) {
    case Style::band:
      svg.path(band_path(places(s, s.y, frame), places(s, s.y2, frame)), css_class);
      break;
    case Style::bars:
      draw_bars(svg, plot, s, frame, css_class);
      break;
    case Style::points:
      draw_error_bars(svg, s, frame, fmt::format("error c{}", colour));
      svg.path(dots_path(places(s, s.y, frame)), css_class + (length(s) > 400 ? " small" : ""));
      break;
    default:
      svg.path(line_path(places(s, s.y, frame)), css_class);
  }
}

std::string label_of(const Plot& plot) {
  std::string label = plot.title;
  if (!plot.y_label.empty()) label += ", " + plot.y_label;
  if (!plot.x_label.empty()) label += " over " + plot.x_label;
  for (std::size_t i = 0; i < plot.series.size(); ++i) label += (i == 0 ? ": " : ", ") + plot.series[i].name;
  return label;
}

std::string draw_plot(const Plot& plot, const std::string& id, const std::string& style, PlotWidth width) {
  if (plot.kind == Plot::Kind::heat_map) return heat_map_svg(plot, style);
  const std::vector<int> colours = channel_colours(plot.series);
  std::vector<LegendEntry> legend;
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    if (const Series& s = plot.series[i]; !s.name.empty())
      legend.push_back({pretty_unit(s.name), class_of(plot, s, colours[i])});
  Svg svg;
  PlotFrame frame = frame_of(plot, width);
  const double height = frame.draw(svg, plot.series.size() > 1 ? legend : std::vector<LegendEntry>{});
  svg.open_clip(id + "-inside", frame.corner, frame.width, frame.height);
  for (const Style layer : kDrawingOrder)
    for (std::size_t i = 0; i < plot.series.size(); ++i)
      if (plot.series[i].style == layer) draw_series(svg, plot, plot.series[i], frame, colours[i]);
  svg.close_clip();
  return svg.finish(frame.paper_width, height, label_of(plot), style);
}

}  // namespace

std::string plot_svg(const Plot& plot, const std::string& id, PlotWidth width) {
  return draw_plot(plot, id, "", width);
}

std::string standalone_svg(const Plot& plot) {
  return draw_plot(plot, "plot", picture_style(), PlotWidth::whole);
}

}  // namespace ident
