// Writes table cells with the class that their content asks for.
#include "ident/report/html_table.h"

#include <algorithm>

#include "ident/report/escape.h"
#include "ident/report/plot_frame.h"
#include "ident/report/text_table.h"

namespace ident {
namespace {

constexpr std::size_t kLongestNumber = 48;  // bytes; what is longer and starts with a digit is a sentence

/// Columns with their numbers aligned, which monospaced cells keep.
std::vector<std::vector<std::string>> aligned_rows(const Table& table) {
  std::vector<std::vector<std::string>> rows = table.rows;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    const bool pairs = std::ranges::any_of(
        rows, [&](const auto& row) { return c < row.size() && row[c].find("±") != std::string::npos; });
    if (pairs) continue;  // too wide, and the eye compares the parameters' values, not their priors
    std::vector<std::string> column;
    for (const auto& row : rows) column.push_back(c < row.size() ? row[c] : "");
    align_points(column);
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (c < rows[r].size()) rows[r][c] = column[r];
  }
  return rows;
}

std::string class_of(const std::string& column, const std::string& cell) {
  if (column == "Identifiable") return cell == "yes" ? "good" : "bad";
  if (column == "Unit" || column == "unit") return "unit";
  if (cell.size() > kLongestNumber) return "";
  const bool interval = cell.starts_with('[') && cell.find_first_of("0123456789") != std::string::npos;
  return is_number(cell.substr(std::min(cell.size(), cell.find_first_not_of(' ')))) || interval ? "number"
                                                                                                : "";
}

std::string cell_of(const std::string& css_class, const std::string& text) {
  return (css_class.empty() ? "<td>" : "<td class=\"" + css_class + "\">") + escape_html(text) + "</td>";
}

std::string head_of(const Table& table, const std::string& caption, const std::string& kind = "") {
  std::string out = "<div class=\"scroll" + kind + "\" tabindex=\"0\"><table>";
  if (!caption.empty()) out += "<caption>" + html_text(caption) + "</caption>";
  out += "<thead><tr>";
  for (const std::string& name : table.columns) out += "<th scope=\"col\">" + html_text(name) + "</th>";
  return out + "</tr></thead>\n<tbody>\n";
}

}  // namespace

std::string html_text(const std::string& text) { return escape_html(pretty_unit(text)); }

std::string html_table(const Table& table, const std::string& caption) {
  if (table.columns.empty()) return "";
  std::string out = head_of(table, caption);
  for (const auto& row : aligned_rows(table)) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string& column = c < table.columns.size() ? table.columns[c] : "";
      out += c == 0 ? "<th scope=\"row\">" + html_text(row[c]) + "</th>"
                    : cell_of(class_of(column, row[c]), pretty_unit(row[c]));
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string verbatim_table(const Table& table) {
  std::string out = head_of(table, "", " machine");
  for (const auto& row : table.rows)
    out += "<tr><th scope=\"row\">" + escape_html(row.at(0)) + "</th>" + cell_of("verbatim", row.at(1)) +
           "</tr>\n";
  return out + "</tbody></table></div>\n";
}

}  // namespace ident
