// The loop over rows and chosen columns.
#include "ident/io/csv/read_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"
#include "ident/io/csv/cell_numbers.h"

namespace ident {
namespace {

using Cells = std::vector<std::string_view>;

constexpr std::size_t kShownCell = 40;  // characters of a cell that a message shows

std::string shown(std::string_view cell) {
  return std::string(cell.substr(0, kShownCell)) + (cell.size() > kShownCell ? "..." : "");
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string_view hint(std::string_view cell) {
  return looks_like_number(cell) ? " here (a decimal comma, but the file's decimal mark is a point?)" : "";
}

class Loop {
 public:
  Loop(const std::string& path, CsvReader& csv, const std::vector<ChosenColumn>& columns,
       const std::vector<ChosenText>& text)
      : path_(path),
        csv_(csv),
        columns_(columns),
        text_(text),
        numbers_(csv.dialect()),
        row_(columns.size()),
        grouped_(columns.size()) {
    table_.file = path;
    for (const ChosenColumn& c : columns) table_.columns.push_back({c.name, csv.header()[c.index], {}});
    for (const ChosenText& c : text) table_.text.push_back({c.name, {}});
    for (Column& column : table_.columns) column.values.reserve(csv.about_rows());
    table_.line.reserve(csv.about_rows());
  }

  NumberTable run() {
    Cells cells;
    while (csv_.next_row(cells))
      if (!is_header_again(cells) && take_numbers(cells)) take_row(cells);
    if (table_.rows() > 0) judge_last_line();
    if (csv_.short_rows_are_damage()) drop_rows(short_rows_);
    if (table_.rows() == 0) throw InputError(path_, csv_.header_line(), "", "has a header, but no rows");
    expect_thousands_alike();
    finish();
    return std::move(table_);
  }

 private:
  const std::string& header(std::size_t column) const { return csv_.header()[columns_[column].index]; }

  /// The header in the middle of the rows: files that were put together.
  bool is_header_again(const Cells& cells) {
    const bool again = std::ranges::all_of(columns_, [&](const ChosenColumn& c) {
      return !cells[c.index].empty() && cells[c.index] == csv_.header()[c.index];
    });
    if (!again || columns_.empty()) return false;
    if (header_again_++ == 0)
      table_.warnings.push_back(
          {"repeated_header", fmt::format("{}:{}: the header stands there again: files that were "
                                          "put together?",
                                          path_, csv_.line())});
    return true;
  }

  /// Numbers of this row into `row_`; false where the row was cut off and dropped.
  bool take_numbers(const Cells& cells) {
    const bool is_short = csv_.is_short_row();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::string_view cell = cells[columns_[i].index];
      const std::optional<double> number = columns_[i].is_time && cell.find(':') != std::string_view::npos
                                               ? read_clock(cell)
                                               : read_number(cell, i);
      if (!number) {
        is_short ? csv_.drop_short() : refuse_or_drop(cell, i);
        return false;
      }
      row_[i] = *number;
    }
    return true;
  }

  std::optional<double> read_number(std::string_view cell, std::size_t i) {
    if (columns_[i].is_time && clock_seen_ && !cell.empty()) return std::nullopt;
    const ChosenColumn& c = columns_[i];
    const bool percent = c.is_fraction && cell.ends_with('%');
    if (percent) cell = cell.substr(0, cell.find_last_not_of(" %") + 1);
    const std::optional<double> number = numbers_.read(cell, header(i), csv_.line());
    if (!number) return number;
    note_thousands(*number, i);
    if (percent) return c.scale * (*number / 100.0) + c.offset;
    return c.unit * (c.scale * *number + c.offset);
  }

  /// 1,234 may have a decimal comma: a column that has marks of thousands has them from 1000 on.
  void note_thousands(double number, std::size_t i) {
    Grouped& g = grouped_[i];
    if (numbers_.had_thousands())
      g.line = g.line > 0 ? g.line : csv_.line();
    else if (std::abs(number) >= 1000.0)
      g.plain = g.plain > 0 ? g.plain : csv_.line();
  }

  void expect_thousands_alike() {
    for (std::size_t i = 0; i < grouped_.size(); ++i) {
      const Grouped& g = grouped_[i];
      if (g.line == 0) continue;
      if (g.plain > 0)
        throw InputError(
            path_, g.line, header(i),
            fmt::format("a mark of thousands here and none in line {}: is it a decimal mark?", g.plain));
      table_.notices.push_back(fmt::format("{}:{}: {}: marks of thousands", path_, g.line, header(i)));
    }
  }

  std::optional<double> read_clock(std::string_view cell) {
    if (!clock_seen_ && table_.rows() > 0) return std::nullopt;
    clock_seen_ = true;
    return numbers_.read_clock(cell);
  }

  void refuse_or_drop(std::string_view cell, std::size_t i) {
    const InputError error(path_, csv_.line(), header(i),
                           fmt::format("'{}' is not a number{}", shown(cell), hint(cell)));
    if (!csv_.at_unfinished_end()) throw error;
    csv_.drop_unfinished();
  }

  void take_row(const Cells& cells) {
    for (std::size_t k = 0; k < text_.size(); ++k) table_.text[k].values.push_back(word(cells, text_[k]));
    for (std::size_t i = 0; i < columns_.size(); ++i) table_.columns[i].values.push_back(row_[i]);
    table_.line.push_back(csv_.line());
    if (csv_.is_short_row()) short_rows_.push_back(table_.rows() - 1);
  }

  /// A line without an end is no data where rows were recorded one after the other: its last number may be
  /// cut. Of a table that was written by hand only the newline is missing.
  void judge_last_line() {
    if (table_.line.back() != csv_.last_content_line() || !csv_.is_unfinished()) return;
    const bool is_short = !short_rows_.empty() && short_rows_.back() + 1 == table_.rows();
    const bool recorded = std::ranges::any_of(columns_, [](const ChosenColumn& c) { return c.is_time; });
    if (!is_short && (!recorded || table_.rows() < 2)) {
      table_.notices.push_back(path_ + ": the last line has no end; its row is taken as whole");
      return;
    }
    csv_.drop_unfinished();
    if (is_short) short_rows_.pop_back();
    drop_rows({table_.rows() - 1});
  }

  /// `rows` in rising order.
  void drop_rows(const std::vector<std::size_t>& rows) {
    const auto drop = [&](auto& values) {
      std::size_t next = 0, kept = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (next < rows.size() && rows[next] == i)
          ++next;
        else if (kept++ != i)
          values[kept - 1] = std::move(values[i]);
      }
      values.resize(kept);
    };
    for (Column& column : table_.columns) drop(column.values);
    for (TextColumn& column : table_.text) drop(column.values);
    drop(table_.line);
  }

  std::string word(const Cells& cells, const ChosenText& column) const {
    std::string text = lower(cells[column.index]);
    if (!column.words.empty() && std::ranges::find(column.words, text) == column.words.end())
      throw InputError(path_, csv_.line(), csv_.header()[column.index],
                       fmt::format("'{}' is none of {}{}", shown(cells[column.index]),
                                   fmt::join(column.words, ", "), did_you_mean(text, column.words)));
    return text;
  }

  void finish() {
    for (const Warning& warning : csv_.warnings()) table_.warnings.push_back(warning);
    for (const Warning& warning : numbers_.warnings(path_)) table_.warnings.push_back(warning);
    const std::vector<std::string> of_file = csv_.notices();
    table_.notices.insert(table_.notices.begin(), of_file.begin(), of_file.end());
    if (numbers_.used_decimal_comma() && csv_.dialect().decimal != DecimalMark::comma)
      table_.notices.push_back(path_ + ": decimal comma");
    if (!clock_seen_) return;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!columns_[i].is_time) continue;
      std::vector<double>& t = table_.columns[i].values;
      const double first = t.front();
      for (double& value : t) value -= first;
    }
    table_.notices.push_back(path_ + ": clock times, counted from the first row");
  }

  const std::string& path_;
  CsvReader& csv_;
  const std::vector<ChosenColumn>& columns_;
  const std::vector<ChosenText>& text_;
  CellNumbers numbers_;
  NumberTable table_;
  std::vector<double> row_;
  struct Grouped {
    long line = 0, plain = 0;  ///< first lines with a mark of thousands, and without one from 1000 on
  };
  std::vector<Grouped> grouped_;  ///< of each column
  std::vector<std::size_t> short_rows_;
  long header_again_ = 0;
  bool clock_seen_ = false;
};

}  // namespace

NumberTable read_columns(const std::string& path, CsvReader& csv, const std::vector<ChosenColumn>& columns,
                         const std::vector<ChosenText>& text) {
  return Loop(path, csv, columns, text).run();
}

}  // namespace ident
