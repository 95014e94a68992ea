// Heat maps: one hue whose strength is the value, a second one for negative values, so that zero is the
// paper.
#pragma once

#include "ident/report/plot_svg.h"

namespace ident {

/// Heat map of `plot.cells`; used by `plot_svg`.
std::string heat_map_svg(const Plot& plot, const std::string& style);

/// A correlation matrix as a heat map.
Plot correlation_plot(const Result& result);

}  // namespace ident
