// What a command found: parameters with intervals, findings, and the pictures that show them; data only.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ident/core/math.h"
#include "ident/result/correlation.h"

namespace ident {

/// An estimate in SI units. `std` is corrected for the colour of the residuals, `naive_std` is not.
struct Parameter {
  std::string name;  ///< as in the file formats: kT, Jxx, rotor_drag.kd
  double value = kNaN;
  double std = kNaN;
  std::array<double, 2> ci95{kNaN, kNaN};
  std::string unit;
  bool identifiable = true;
  std::string source;  ///< command that found it: thrust, motor, flightlog, prior
  std::optional<double> naive_std;
  std::optional<double> prior_value, prior_std;
  std::optional<double> pull;         ///< (value - prior) over its standard deviation
  std::optional<double> from_flight;  ///< share of the information that came from the data, 0 to 1
  std::string note;                   ///< why not identifiable, in words
  /// Not identifiable by itself, and yet of one model with what is: known together, they are stored together.
  bool joint = false;
  bool known_together = false;  ///< with others, before: the pull is that against what was known of them all

  /// Nothing to be used, whatever its deviation says.
  void doubt(std::string why) {
    if (identifiable) note = std::move(why);
    identifiable = joint = false;
  }
};

/// A named finding; the text says what was seen and what to do about it.
struct Warning {
  std::string code;
  std::string message;
};

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

/// A file that was read, so that a stranger can tell whether he has the same one.
struct InputFile {
  std::string path;
  std::string sha256;
};

/// Everything a command has to say. `to_json` is what `--json` prints; the report shows all of it.
struct Result {
  std::string schema = "ident.result/1";
  std::string command;
  std::vector<std::string> inputs;
  std::vector<Parameter> parameters;
  nlohmann::ordered_json fit = nlohmann::ordered_json::object();
  std::vector<Warning> warnings;
  nlohmann::ordered_json extra = nlohmann::ordered_json::object();  ///< merged into the top level
  std::string verdict;                                              ///< plain words, one paragraph
  std::vector<Section> sections;
  Correlation correlation;        ///< of the estimates
  Correlation prior_correlation;  ///< of what was known of them before
  std::vector<InputFile> files;
  std::vector<std::string> command_line;
  std::optional<std::uint64_t> seed;
  std::string version;  ///< of the ident that found it; empty for this one

  void warn(std::string code, std::string message) {
    warnings.push_back({std::move(code), std::move(message)});
  }
  const Parameter* find(const std::string& name) const;
  bool has_warning(const std::string& code) const;
};

/// The contract's JSON. Non-finite numbers become null on purpose ("not identified").
nlohmann::ordered_json to_json(const Result& result);

}  // namespace ident
