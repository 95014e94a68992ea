// A table of numbers as it was measured: named columns in SI units, NaN where a cell was empty.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ident/result/finding.h"

namespace ident {

/// One column in SI units (`rpm` is already rad/s and called `omega`, ...). NaN is "not sampled".
struct Column {
  std::string name;    ///< canonical signal name, lower case: omega, thrust, t, delta1
  std::string header;  ///< as it stood in the file
  std::vector<double> values;
};

/// A cell of text that is not a number (`axis` of a pendulum file) keeps its spelling here.
struct TextColumn {
  std::string name;
  std::vector<std::string> values;
};

/// Rows of one file. All columns have the same length; `line[i]` is the line of row i in the file.
struct NumberTable {
  std::string file;
  std::vector<Column> columns;
  std::vector<TextColumn> text;  ///< columns of words
  std::vector<long> line;
  std::vector<Warning> warnings;     ///< what was noticed while reading (ignored columns, separator)
  std::vector<std::string> notices;  ///< decisions worth printing: separator, decimal mark, encoding

  std::size_t rows() const { return line.size(); }
  /// The column of that canonical name, or nullptr.
  const std::vector<double>* find(std::string_view name) const {
    for (const Column& c : columns)
      if (c.name == name) return &c.values;
    return nullptr;
  }
  /// Cells of the column of words of that name, or nullptr.
  const std::vector<std::string>* find_text(std::string_view name) const {
    for (const TextColumn& c : text)
      if (c.name == name) return &c.values;
    return nullptr;
  }
};

}  // namespace ident
