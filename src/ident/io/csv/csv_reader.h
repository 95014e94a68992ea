// Header and rows of a table of any dialect: cells, not yet numbers.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "ident/io/csv/csv_dialect.h"
#include "ident/io/csv/line_source.h"
#include "ident/result/result.h"

namespace ident {

/// Reads the header at once, then row by row. Comments (#), blank lines and lines before the header are
/// passed over, stray lines of text are dropped with a warning. Throws InputError.
class CsvReader {
 public:
  /// `names`: the header of a file that has none, with commas; what stands before its first row is passed
  /// over.
  explicit CsvReader(const std::string& path, const std::string& names = {});

  const std::vector<std::string>& header() const { return header_; }  ///< UTF-8, as they stand there
  long header_line() const { return header_line_; }
  const CsvDialect& dialect() const { return dialect_; }
  /// About how many rows the file holds, by its size and its first lines; 0 where it has no size.
  std::size_t about_rows() const { return about_rows_; }

  /// The cells of the next row, as many as the header has; false at the end. They hold until the next call.
  bool next_row(std::vector<std::string_view>& cells);
  /// Whether the row that was read last has fewer cells than the header; the others were given as empty.
  bool is_short_row() const { return last_short_ == line_; }
  /// Line of the row that was read last.
  long line() const { return line_; }
  /// Whether the row read last is the end of a file without a final newline, so that its last cell may be
  /// cut. Reads ahead: the cells are gone afterwards.
  bool at_unfinished_end();
  /// Whether the file ends without a final newline; known after the last row.
  bool is_unfinished() const { return !source_.ended_with_newline(); }
  /// Says that the row that was read last was cut off and is dropped.
  void drop_unfinished();
  /// Says that a row with missing cells cannot be read and is dropped.
  void drop_short() { dropped_short_ = true; }
  /// Whether rows with fewer cells than the header are damage, to be dropped: they are few. A spreadsheet
  /// leaves out empty cells at the end of many rows. Known after the last row.
  bool short_rows_are_damage() const { return short_rows_are_damage_; }
  long last_content_line() const { return last_content_; }

  /// What was noticed, complete after the last row.
  const std::vector<Warning>& warnings() const { return warnings_; }
  /// Separator, decimal mark and encoding in words.
  std::vector<std::string> notices() const;

 private:
  struct Line {
    std::string text;
    long number;
  };
  bool next_line(std::string_view& line);
  bool next_content_line(std::string_view& line);
  void read_header(const std::string& names);
  /// Drops lines before the header and the header from `lines`, and returns the latter.
  std::string take_header(std::deque<Line>& lines, const std::string& names);
  void expect_names() const;
  void guess_rows(const std::vector<std::string>& sample);
  /// False where it is no row at all.
  bool take_short_row(const std::vector<std::string_view>& cells);
  void close();

  std::string path_;
  LineSource source_;
  std::deque<Line> ahead_;
  std::string current_;  ///< text of a line that was taken from `ahead_`
  std::vector<std::string> header_;
  std::size_t named_ = 0;  ///< columns up to the last one with a name
  std::size_t about_rows_ = 0;
  CsvDialect dialect_;
  std::vector<Warning> warnings_;
  long header_line_ = 0, line_ = 0, rows_ = 0;
  long short_rows_ = 0, first_short_ = 0, last_short_ = 0, last_content_ = 0;
  std::size_t short_cells_ = 0;
  long stray_lines_ = 0, first_stray_ = 0;
  bool dropped_short_ = false, short_rows_are_damage_ = false;
  std::vector<std::string> passed_over_;  ///< notices: lines before the table, cells that are not there
  bool closed_ = false;
};

}  // namespace ident
