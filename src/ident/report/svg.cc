// The SVG elements that plots are made of.
#include "ident/report/svg.h"

#include <fmt/format.h>

#include <cmath>

#include "ident/report/escape.h"
#include "ident/report/text_table.h"

namespace ident {
namespace {

std::string class_of(std::string_view css_class) {
  return css_class.empty() ? "" : fmt::format(" class=\"{}\"", css_class);
}

}  // namespace

std::string coordinate(double pixels) {
  const double rounded = std::round(pixels * 10) / 10;
  return fmt::format("{:g}", rounded == 0 ? 0.0 : rounded);
}

double label_width(std::string_view text) { return 7.3 * display_width(text); }

void Svg::text(PaperPoint at, std::string_view text, std::string_view css_class, double turn_deg) {
  const std::string turn = turn_deg == 0 ? ""
                                         : fmt::format(" transform=\"rotate({:g} {} {})\"", turn_deg,
                                                       coordinate(at.x), coordinate(at.y));
  body_ += fmt::format("<text x=\"{}\" y=\"{}\"{}{}>{}</text>\n", coordinate(at.x), coordinate(at.y),
                       class_of(css_class), turn, escape_html(text));
}

void Svg::line(PaperPoint from, PaperPoint to, std::string_view css_class) {
  path(
      fmt::format("M{} {}L{} {}", coordinate(from.x), coordinate(from.y), coordinate(to.x), coordinate(to.y)),
      css_class);
}

void Svg::rectangle(PaperPoint corner, double width, double height, std::string_view css_class,
                    std::string_view style, std::string_view tooltip) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}", coordinate(corner.x),
                       coordinate(corner.y), coordinate(width), coordinate(height), class_of(css_class));
  if (!style.empty()) body_ += fmt::format(" style=\"{}\"", style);
  body_ += tooltip.empty() ? "/>\n" : fmt::format("><title>{}</title></rect>\n", escape_html(tooltip));
}

void Svg::path(std::string_view commands, std::string_view css_class) {
  if (!commands.empty()) body_ += fmt::format("<path{} d=\"{}\"/>\n", class_of(css_class), commands);
}

void Svg::open_clip(std::string_view id, PaperPoint corner, double width, double height) {
  body_ += fmt::format(
      "<clipPath id=\"{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>\n"
      "<g clip-path=\"url(#{0})\">\n",
      id, coordinate(corner.x), coordinate(corner.y), coordinate(width), coordinate(height));
}

void Svg::close_clip() { body_ += "</g>\n"; }

std::string Svg::finish(double width, double height, std::string_view label, std::string_view style) const {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" aria-label=\"{2}\">\n",
      coordinate(width), coordinate(height), escape_html(label));
  if (!style.empty()) out += fmt::format("<style>{}</style>\n", style);
  return out + body_ + "</svg>\n";
}

}  // namespace ident
