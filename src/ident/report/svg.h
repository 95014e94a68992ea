// Writes the elements of a picture; colours and fonts come from the style sheet by class.
#pragma once

#include <string>
#include <string_view>

namespace ident {

/// A place on the paper, in pixels from the top left.
struct PaperPoint {
  double x, y;
};

/// Coordinates with one decimal, the shortest way.
std::string coordinate(double pixels);

/// Width of a label in the plot's font, roughly.
double label_width(std::string_view text);

/// Collects SVG elements. Texts are escaped here.
class Svg {
 public:
  void text(PaperPoint at, std::string_view text, std::string_view css_class = "", double turn_deg = 0);
  void line(PaperPoint from, PaperPoint to, std::string_view css_class);
  void rectangle(PaperPoint corner, double width, double height, std::string_view css_class,
                 std::string_view style = "", std::string_view tooltip = "");
  void path(std::string_view commands, std::string_view css_class);
  void open_clip(std::string_view id, PaperPoint corner, double width, double height);
  void close_clip();

  /// The whole picture; `label` is read aloud in its place.
  std::string finish(double width, double height, std::string_view label, std::string_view style = "") const;

 private:
  std::string body_;
};

}  // namespace ident
