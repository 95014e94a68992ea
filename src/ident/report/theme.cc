// Puts the style sheets together; the dark colours are written once and serve preference and choice.
#include "ident/report/theme.h"

#include "ident/report/assets.h"

namespace ident {
namespace {

std::string block(std::string_view selector, std::string_view content) {
  return std::string(selector) + " {\n" + std::string(content) + "}\n";
}

}  // namespace

std::string page_style() {
  const std::string dark =
      block(":root[data-theme=\"dark\"]", kDarkColours) +
      block("@media (prefers-color-scheme: dark)", block(":root:not([data-theme=\"light\"])", kDarkColours));
  return block(":root", kLightColours) + block("@media screen", dark) + std::string(kPlotLibraryStyle) +
         std::string(kPlotStyle) + std::string(kPageStyle);
}

std::string picture_style() {
  return block("svg", kLightColours) +
         block("@media (prefers-color-scheme: dark)", block("svg", kDarkColours)) + std::string(kPlotStyle) +
         "svg { background: var(--page); }";
}

}  // namespace ident
