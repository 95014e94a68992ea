// Heat maps: one hue whose strength is the value, a second one for negative values, so that zero is the
// paper.
#include "ident/report/heat_map.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/core/format_number.h"
#include "ident/report/plot_frame.h"

namespace ident {
namespace {

constexpr double kBarRoom = 92;    // colour bar and its labels
constexpr double kCellText = 0.9;  // size of the text on a cell over that of labels
constexpr double kStrong = 0.62;   // from here on the text on a cell takes the colour of the paper

/// Values to strengths: 0 is the paper, 1 the full hue.
struct Shade {
  double low = 0, high = 1;

  explicit Shade(const Eigen::MatrixXd& cells) {
    Extent extent;
    for (const double cell : cells.reshaped()) extent.add(cell);
    if (extent.empty()) return;
    high = std::max(std::abs(extent.low), std::abs(extent.high));
    if (high == 0) high = 1;
    // Values far from zero differ too little for a scale that starts there.
    low = extent.low < 0                   ? -high
          : extent.low > 0.5 * extent.high ? extent.low - 0.1 * (extent.high - extent.low)
                                           : 0;
    if (low == high) low = 0;
  }

  double strength(double value) const {
    return low < 0 ? std::abs(value) / high : (value - low) / (high - low);
  }

  void draw(Svg& svg, PaperPoint corner, double width, double height, double value,
            const std::string& tooltip) const {
    const char* css_class = !std::isfinite(value) ? "heat none"
                            : value < 0           ? "heat negative"
                                                  : "heat positive";
    const std::string style = std::isfinite(value) ? fmt::format("fill-opacity:{:.3g}", strength(value)) : "";
    svg.rectangle(corner, width, height, css_class, style, tooltip);
  }
};

void draw_colour_bar(Svg& svg, const Shade& shade, PaperPoint corner, double height) {
  constexpr int kSteps = 24;
  for (int i = 0; i < kSteps; ++i) {
    const double value = shade.high + (shade.low - shade.high) * (i + 0.5) / kSteps;
    shade.draw(svg, {corner.x, corner.y + height * i / kSteps}, 14, height / kSteps, value, "");
  }
  svg.text({corner.x + 20, corner.y + 9}, format_number(shade.high, 2));
  if (shade.low < 0) svg.text({corner.x + 20, corner.y + height / 2 + 4}, "0");
  svg.text({corner.x + 20, corner.y + height}, format_number(shade.low, 2));
}

double widest_name(const std::vector<std::string>& names) {
  double width = 0;
  for (const std::string& name : names) width = std::max(width, label_width(name));
  return width;
}

std::string name_of(const std::vector<std::string>& names, Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  return k < names.size() ? names[k] : "";
}

/// Where the cells stand on the paper.
struct Grid {
  double left, top = 12, cell_width, cell_height, names_height;
  bool turned;  ///< column names, where they do not fit beside each other

  explicit Grid(const Plot& plot) {
    left = std::min(220.0, widest_name(plot.row_names)) + 14 + (plot.y_label.empty() ? 0 : 24);
    const auto rows = static_cast<double>(plot.cells.rows()),
               columns = static_cast<double>(plot.cells.cols());
    cell_width = std::clamp((PlotFrame::kPaperWidth - left - kBarRoom) / columns, 4.0, 72.0);
    cell_height = std::clamp(420 / rows, 8.0, std::min(cell_width, 44.0));
    if (cell_height < 20) cell_height = std::clamp(620 / rows, 4.0, 20.0);
    turned = widest_name(plot.column_names) > cell_width - 4;
    names_height = turned ? 0.72 * widest_name(plot.column_names) + 16 : 22;
  }
  PaperPoint corner(Eigen::Index row, Eigen::Index column) const {
    return {left + cell_width * static_cast<double>(column), top + cell_height * static_cast<double>(row)};
  }
};

/// As much of a number as fits into a cell.
std::string number_in(double room, double value) {
  for (const std::string& text :
       {format_number(value, 2), fmt::format("{:.2f}", value), fmt::format("{:.1f}", value)})
    if (kCellText * label_width(text) <= room) return text;
  return "";
}

void draw_cells(Svg& svg, const Plot& plot, const Grid& grid, const Shade& shade) {
  const bool written = grid.cell_width >= 36 && grid.cell_height >= 17;
  for (Eigen::Index r = 0; r < plot.cells.rows(); ++r)
    for (Eigen::Index c = 0; c < plot.cells.cols(); ++c) {
      const double value = plot.cells(r, c);
      const std::string number = format_number(value, 2);
      const PaperPoint at = grid.corner(r, c);
      shade.draw(svg, at, grid.cell_width, grid.cell_height, value,
                 name_of(plot.row_names, r) + ", " + name_of(plot.column_names, c) + ": " + number);
      if (written)
        svg.text({at.x + grid.cell_width / 2, at.y + grid.cell_height / 2 + 4},
                 std::isfinite(value) ? number_in(grid.cell_width - 2, value) : number,
                 std::isfinite(value) && shade.strength(value) > kStrong ? "middle cell on-strong"
                                                                         : "middle cell");
    }
}

void draw_names(Svg& svg, const Plot& plot, const Grid& grid) {
  for (Eigen::Index r = 0; r < plot.cells.rows(); ++r)
    svg.text({grid.left - 8, grid.corner(r, 0).y + grid.cell_height / 2 + 4}, name_of(plot.row_names, r),
             "end");
  const double base = grid.corner(plot.cells.rows(), 0).y;
  for (Eigen::Index c = 0; c < plot.cells.cols(); ++c) {
    const double x = grid.corner(0, c).x + grid.cell_width / 2;
    const std::string name = name_of(plot.column_names, c);
    if (grid.turned)
      svg.text({x + 4, base + 14}, name, "end", -45);
    else
      svg.text({x, base + 16}, name, "middle");
  }
}

}  // namespace

std::string heat_map_svg(const Plot& plot, const std::string& style) {
  Svg svg;
  const Grid grid(plot);
  const Shade shade(plot.cells);
  draw_cells(svg, plot, grid, shade);
  draw_names(svg, plot, grid);
  const PaperPoint end = grid.corner(plot.cells.rows(), plot.cells.cols());
  draw_colour_bar(svg, shade, {end.x + 18, grid.top}, std::max(60.0, end.y - grid.top));
  if (!plot.y_label.empty())
    svg.text({14, (grid.top + end.y) / 2}, pretty_unit(plot.y_label), "middle label", -90);
  double height = std::max(end.y, grid.top + 60) + grid.names_height;
  if (!plot.x_label.empty()) {
    svg.text({(grid.left + end.x) / 2, height + 16}, pretty_unit(plot.x_label), "middle label");
    height += 26;
  }
  return svg.finish(PlotFrame::kPaperWidth, height + 4, plot.title, style);
}

Plot correlation_plot(const Result& result) {
  return {.id = "correlation",
          .title = "Correlation of the estimates",
          .caption = "Near 1 or -1 the data determine a combination of the two, not each alone.",
          .kind = Plot::Kind::heat_map,
          .cells = result.correlation.matrix,
          .row_names = result.correlation.names,
          .column_names = result.correlation.names};
}

}  // namespace ident
