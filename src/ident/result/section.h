// Parts of a report as data: series, plots, tables and the section that holds them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace ident {

/// One set of points in a plot. Non-finite values are gaps. What `y2` holds depends on the style: a band
/// fills from y to y2, a bar floats from y2 to y (a waterfall), a point has an error bar of +-y2.
struct Series {
  enum class Style { line, points, bars, measured, predicted, band };
  std::string
      name;  ///< the channel; the same name has the same colour everywhere: "p measured", "p predicted"
  std::vector<double> x, y, y2;
  Style style = Style::line;
};

/// A picture as data; axis labels carry the unit, `time_series` asks for an interactive plot. In an xy plot
/// with `column_names` the x of bars is the index of a name.
struct Plot {
  enum class Kind { xy, time_series, heat_map };
  std::string id, title, caption;
  std::string x_label, y_label;
  Kind kind = Kind::xy;
  bool log_x = false, log_y = false;  ///< xy only
  std::vector<Series> series;
  Eigen::MatrixXd cells;  ///< heat map only, rows by columns; negative values get a second hue
  std::vector<std::string> row_names, column_names;
};

/// A table as text cells; numbers are already rounded to their uncertainty.
struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// One part of a report, in the order in which it is read.
struct Section {
  std::string title, text;
  std::vector<Table> tables;
  std::vector<Plot> plots;
};

}  // namespace ident
