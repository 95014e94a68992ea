// Style sheet and scripts of the HTML page, embedded by the build.
#pragma once

#include <string_view>

namespace ident {

extern const std::string_view kLightColours;  ///< declarations of custom properties
extern const std::string_view kDarkColours;
extern const std::string_view kPlotStyle;
extern const std::string_view kPageStyle;
extern const std::string_view kPageScript;
extern const std::string_view kPlotLibrary;       ///< uPlot; empty when the build did not find it
extern const std::string_view kPlotLibraryStyle;  ///< likewise

}  // namespace ident
