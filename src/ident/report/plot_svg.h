// Pictures of plots as SVG: xy plots, bars, bands and heat maps.
#pragma once

#include <string>

#include "ident/result/result.h"

namespace ident {

/// Of the page's width; a half leaves room for another picture beside it.
enum class PlotWidth { whole, half };

/// The picture for a page with the style sheet. `id` is unique on the page.
std::string plot_svg(const Plot& plot, const std::string& id, PlotWidth width = PlotWidth::whole);

/// The picture as a file of its own, which carries its colours for light and dark.
std::string standalone_svg(const Plot& plot);

}  // namespace ident
