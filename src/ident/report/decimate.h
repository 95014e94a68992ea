// Fewer points for the same picture: what a pixel cannot show is not drawn.
#pragma once

#include <string>
#include <vector>

#include "ident/report/svg.h"

namespace ident {

/// Path commands of a line; not finite points break it. Of the points in one pixel column the first, lowest,
/// highest and last are kept.
std::string line_path(const std::vector<PaperPoint>& points);

/// Path commands that put a dot at each point, one per cell of about a pixel; stroke with a round cap.
std::string dots_path(const std::vector<PaperPoint>& points);

/// Path commands of the area between two edges of equal length.
std::string band_path(const std::vector<PaperPoint>& low, const std::vector<PaperPoint>& high);

}  // namespace ident
