// Draws axes, grid, labels and legend of an xy plot.
#include "ident/report/plot_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ident {
namespace {

constexpr double kLegendRow = 20, kLegendGap = 22, kSwatch = 22;
constexpr double kTickGap = 7, kLabelGap = 38, kRight = 18, kTop = 10;

double widest(const Scale& scale) {
  double width = 0;
  for (const Tick& tick : scale.ticks()) width = std::max(width, label_width(tick.label));
  return width;
}

std::string with_factor(const std::string& label, const Scale& scale) {
  return scale.factor().empty() ? label : label + "  (" + scale.factor() + ")";
}

/// Draws the legend in rows from the top and returns its height.
double draw_legend(Svg& svg, const std::vector<LegendEntry>& legend, double left, double right) {
  if (legend.empty()) return 0;
  double x = left, y = kTop + 8;
  for (const LegendEntry& entry : legend) {
    const double width = kSwatch + 6 + label_width(entry.name);
    if (x > left && x + width > right) x = left, y += kLegendRow;
    const bool filled =
        entry.css_class.find("bar") != std::string::npos || entry.css_class.find("band") != std::string::npos;
    if (filled)
      svg.rectangle({x + 4, y - 6}, 14, 12, entry.css_class);
    else if (entry.css_class.find("dots") != std::string::npos)
      svg.path("M" + coordinate(x + 5) + " " + coordinate(y) + "h0m12 0h0", entry.css_class + " swatch");
    else
      svg.line({x, y}, {x + kSwatch, y}, entry.css_class);
    svg.text({x + kSwatch + 6, y + 4}, entry.name, "legend");
    x += width + kLegendGap;
  }
  return y + 8;
}

bool two_lines(const std::string& text, double room) {
  return label_width(text) > room && text.rfind(" [") != std::string::npos;
}

/// The label of the vertical axis, its unit on a line of its own where both together are too long.
void draw_side_label(Svg& svg, const std::string& text, double middle, double room) {
  if (!two_lines(text, room)) return svg.text({14, middle}, text, "middle label", -90);
  const std::size_t unit = text.rfind(" [");
  svg.text({11, middle}, text.substr(0, unit), "middle label", -90);
  svg.text({26, middle}, text.substr(unit + 1), "middle label", -90);
}

}  // namespace

double PlotFrame::draw(Svg& svg, const std::vector<LegendEntry>& legend) {
  const Scale& horizontal = sideways ? across : along;
  const Scale& vertical = sideways ? along : across;
  const std::string bottom = with_factor(pretty_unit(sideways ? across_label : along_label), horizontal);
  const std::string side = with_factor(pretty_unit(sideways ? along_label : across_label), vertical);

  const double left =
      std::max(30.0, widest(vertical) + kTickGap + 6) + (side.empty()                    ? 0
                                                         : two_lines(side, inner_height) ? 36
                                                                                         : 24);
  corner = {left, kTop + draw_legend(svg, legend, left, paper_width - kRight)};
  width = paper_width - kRight - left;
  height = inner_height;
  const double base = corner.y + height;

  double taken = -1e9;  // to here by the last label; numbers that do not fit beside it are left out
  for (const Tick& tick : horizontal.ticks()) {
    const double x = corner.x + horizontal.position(tick.value) * width, half = label_width(tick.label) / 2;
    if (horizontal.has_grid()) svg.line({x, corner.y}, {x, base}, tick.value == 0 ? "zero" : "grid");
    if (horizontal.has_grid() && x - half < taken + kTickGap) continue;
    svg.text({x, base + 18}, tick.label, "middle");
    taken = x + half;
  }
  for (const Tick& tick : vertical.ticks()) {
    const double share = vertical.position(tick.value);
    const double y = sideways ? corner.y + share * height : base - share * height;
    if (vertical.has_grid())
      svg.line({corner.x, y}, {corner.x + width, y}, tick.value == 0 ? "zero" : "grid");
    svg.text({corner.x - kTickGap, y + 4}, tick.label, "end");
  }
  svg.line({corner.x, base}, {corner.x + width, base}, "axis");
  svg.line({corner.x, corner.y}, {corner.x, base}, "axis");
  if (!bottom.empty()) svg.text({corner.x + width / 2, base + kLabelGap}, bottom, "middle label");
  if (!side.empty()) draw_side_label(svg, side, corner.y + height / 2, height);
  return base + (bottom.empty() ? 26 : 48);
}

PaperPoint PlotFrame::at(double x, double y) const {
  const double a = along.position(x), b = across.position(y);
  return sideways ? PaperPoint{corner.x + b * width, corner.y + a * height}
                  : PaperPoint{corner.x + a * width, corner.y + (1 - b) * height};
}

std::string pretty_unit(std::string text) {
  constexpr std::array<std::array<const char*, 2>, 5> kPowers{
      {{"^-1", "⁻¹"}, {"^-2", "⁻²"}, {"^2", "²"}, {"^3", "³"}, {"^4", "⁴"}}};
  for (const auto& [plain, raised] : kPowers)
    for (std::size_t at = 0; (at = text.find(plain, at)) != std::string::npos;)
      text.replace(at, std::string(plain).size(), raised);
  return text;
}

}  // namespace ident
