// The frame of an xy plot: axes, grid, labels and legend, and where a value stands inside.
#pragma once

#include <string>
#include <vector>

#include "ident/report/scale.h"
#include "ident/report/svg.h"
#include "ident/result/result.h"

namespace ident {

/// A line of the legend: what it is called and how it is drawn.
struct LegendEntry {
  std::string name;
  std::string css_class;
};

/// `along` is the scale of the plot's x, `across` that of its y; `sideways` puts x on the vertical axis,
/// downwards, for bars with long names.
struct PlotFrame {
  Scale along, across;
  std::string along_label, across_label;
  bool sideways = false;
  double inner_height = 260;
  double paper_width = kPaperWidth;
  PaperPoint corner{0, 0};       ///< of the inside, top left; set by draw
  double width = 0, height = 0;  ///< of the inside, likewise

  static constexpr double kPaperWidth = 720, kHalfPaperWidth = 430;

  /// Draws all but the data and returns the height of the paper.
  double draw(Svg& svg, const std::vector<LegendEntry>& legend);
  PaperPoint at(double x, double y) const;
};

/// Superscripts for powers of units: "m/s^2" as "m/s²".
std::string pretty_unit(std::string text);

}  // namespace ident
