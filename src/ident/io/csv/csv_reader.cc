// Header and rows, with a decision for every line that is no proper row.
#include "ident/io/csv/csv_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ident/core/error.h"
#include "ident/io/csv/find_header.h"
#include "ident/io/csv/text_encoding.h"

namespace ident {
namespace {

constexpr std::size_t kSniffedLines = 50;
constexpr double kMostGuessed = 1e6;  // rows, for which room is made at once
constexpr double kShortRowsAllowed =
    0.02;  // share of rows with missing cells that is dropped instead of refused

bool is_comment_or_blank(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string_view::npos || line[first] == '#';
}

/// The given names as the header of a file with that separator.
std::string with_separator(const std::string& names, char separator) {
  std::vector<std::string_view> cells;
  split_cells(names, ',', cells);
  return fmt::format("{}", fmt::join(cells, std::string_view(&separator, 1)));
}

std::size_t width(const std::string& names) {
  std::vector<std::string_view> cells;
  split_cells(names, ',', cells);
  return cells.size();
}

}  // namespace

CsvReader::CsvReader(const std::string& path, const std::string& names) : path_(path), source_(path) {
  read_header(names);
}

bool CsvReader::next_line(std::string_view& line) {
  if (!ahead_.empty()) {
    current_ = std::move(ahead_.front().text);
    line_ = ahead_.front().number;
    ahead_.pop_front();
    line = current_;
    return true;
  }
  const std::optional<std::string_view> next = source_.next();
  if (!next) return false;
  line = *next;
  line_ = source_.line();
  return true;
}

bool CsvReader::next_content_line(std::string_view& line) {
  while (next_line(line))
    if (!is_comment_or_blank(line)) {
      last_content_ = line_;
      return true;
    }
  return false;
}

std::string CsvReader::take_header(std::deque<Line>& lines, const std::string& names) {
  std::vector<std::string> texts;
  for (const Line& line : lines) texts.push_back(line.text);
  const std::size_t rows = names.empty() ? find_header(texts) : find_first_row(texts, width(names));
  if (rows == lines.size())
    throw InputError(
        path_, lines.front().number, "",
        fmt::format("no line holds {} cells with numbers, as many as --header names columns", width(names)));
  const long first = lines.front().number;
  lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(rows));
  if (rows > 0)
    passed_over_.push_back(fmt::format("{}:{}: {} line{} before the table passed over", path_, first, rows,
                                       rows > 1 ? "s" : ""));
  header_line_ = lines.front().number;
  if (!names.empty()) return with_separator(names, sniff_dialect(lines.front().text, texts).separator);
  std::string header = std::move(lines.front().text);
  lines.pop_front();
  return header;
}

void CsvReader::read_header(const std::string& names) {
  std::string_view line;
  if (!next_content_line(line)) throw InputError(path_, 0, "", "is empty: no header and no rows");
  const bool names_separator = line.starts_with("sep=") && line.size() == 5;  // written by spreadsheets
  if (names_separator && !next_content_line(line))
    throw InputError(path_, 0, "", "is empty: no header and no rows");
  if (line.find('\r') != std::string::npos)
    throw InputError(path_, line_, "", "its lines end with CR alone: convert them to LF");
  std::deque<Line> ahead = {{std::string(line), line_}};
  while (ahead.size() <= kSniffedLines && next_content_line(line))
    ahead.push_back({std::string(line), line_});
  const std::string header = take_header(ahead, names);
  std::vector<std::string> sample;
  for (const Line& row : ahead) sample.push_back(row.text);
  ahead_ = std::move(ahead);
  dialect_ = sniff_dialect(header, sample);
  std::vector<std::string_view> cells;
  if (!split_cells(header, dialect_.separator, cells))
    throw InputError(path_, header_line_, "", "a quote in the header is not closed");
  for (const std::string_view cell : cells)
    header_.push_back(dialect_.latin1 ? latin1_to_utf8(cell) : std::string(cell));
  named_ = header_.size();
  while (named_ > 0 && header_[named_ - 1].empty()) --named_;
  expect_names();
  guess_rows(sample);
}

void CsvReader::guess_rows(const std::vector<std::string>& sample) {
  std::size_t bytes = 0;
  for (const std::string& row : sample) bytes += row.size() + 1;
  std::error_code no_size;  // of a pipe
  const auto size = static_cast<double>(std::filesystem::file_size(path_, no_size));
  if (bytes == 0 || no_size) return;
  const double rows = size * static_cast<double>(sample.size()) / static_cast<double>(bytes);
  const double cells = size / static_cast<double>(std::max<std::size_t>(named_, 1));
  about_rows_ = static_cast<std::size_t>(std::min({rows, cells, kMostGuessed}));
}

void CsvReader::expect_names() const {
  const bool only_numbers = std::ranges::all_of(
      header_, [](const std::string& name) { return name.empty() || looks_like_number(name); });
  if (only_numbers)
    throw InputError(
        path_, header_line_, "",
        "there is no header: the first line holds numbers, not names of columns (--header of the bench "
        "commands gives them)");
}

bool CsvReader::take_short_row(const std::vector<std::string_view>& cells) {
  if (std::ranges::none_of(cells, looks_like_number)) {
    if (stray_lines_++ == 0) first_stray_ = line_;
    return false;
  }
  if (short_rows_++ == 0) {
    first_short_ = line_;
    short_cells_ = cells.size();
  }
  last_short_ = line_;
  return true;
}

bool CsvReader::next_row(std::vector<std::string_view>& cells) {
  std::string_view line;
  while (next_content_line(line)) {
    if (!split_cells(line, dialect_.separator, cells))
      throw InputError(path_, line_, "",
                       "a quote is not closed (cells that go over several lines are not read)");
    while (cells.size() > header_.size() && cells.back().empty()) cells.pop_back();
    if (cells.size() > header_.size())
      throw InputError(
          path_, line_, "",
          fmt::format("has {} cells, but the header in line {} names {} columns (a decimal comma, or a "
                      "separator inside a cell?)",
                      cells.size(), header_line_, header_.size()));
    if (cells.size() < named_ && !take_short_row(cells)) continue;
    cells.resize(header_.size());
    ++rows_;
    return true;
  }
  close();
  return false;
}

bool CsvReader::at_unfinished_end() {
  const long line = line_;
  std::string_view next;
  if (next_content_line(next)) {
    ahead_.push_front({std::string(next), line_});
    line_ = line;
    return false;
  }
  line_ = line;
  return !source_.ended_with_newline();
}

void CsvReader::drop_unfinished() {
  --rows_;
  warnings_.push_back(
      {"truncated_last_line",
       fmt::format("{}:{}: the last line is cut off; the row was dropped", path_, last_content_)});
}

void CsvReader::close() {
  if (closed_) return;
  closed_ = true;
  if (last_short_ == last_content_ && last_short_ > 0 && is_unfinished()) --short_rows_, --rows_;
  if (stray_lines_ > 0)
    warnings_.push_back(
        {"stray_line", fmt::format("{}:{}: a line of text among the rows was passed over ({} in all)", path_,
                                   first_stray_, stray_lines_)});
  if (short_rows_ == 0) return;
  const long whole = rows_ - short_rows_;
  const bool few =
      static_cast<double>(short_rows_) <= std::max(1.0, kShortRowsAllowed * static_cast<double>(whole));
  if (whole <= 0 || (!few && dropped_short_))
    throw InputError(path_, first_short_, "",
                     fmt::format("has {} cells, but the header in line {} names {} columns ({} such rows)",
                                 short_cells_, header_line_, header_.size(), short_rows_));
  short_rows_are_damage_ = few;
  if (few)
    warnings_.push_back({"short_row", fmt::format("{}:{}: cells are missing; {} such rows were dropped",
                                                  path_, first_short_, short_rows_)});
  else
    passed_over_.push_back(
        fmt::format("{}:{}: {} rows have fewer cells than the header names columns: the "
                    "others are taken as empty",
                    path_, first_short_, short_rows_));
}

std::vector<std::string> CsvReader::notices() const {
  std::string text = fmt::format("{}: separator {}", path_, separator_name(dialect_.separator));
  if (dialect_.decimal == DecimalMark::comma) text += ", decimal comma";
  text += dialect_.latin1 ? ", Latin-1" : ", UTF-8";
  if (source_.had_byte_order_mark()) text += " with byte order mark";
  std::vector<std::string> list = {std::move(text)};
  list.insert(list.end(), passed_over_.begin(), passed_over_.end());
  return list;
}

}  // namespace ident
