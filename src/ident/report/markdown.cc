// The Markdown twin of a report, for repositories: the same content, with its figures named.
#include "ident/core/format_number.h"
#include "ident/report/blocks.h"
#include "ident/report/escape.h"
#include "ident/report/report.h"

namespace ident {
namespace {

std::string heading(int level, const std::string& text) {
  return std::string(static_cast<std::size_t>(level), '#') + " " + escape_markdown(text) + "\n\n";
}

std::string row_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + escape_markdown(cell) + " |";
  return line + "\n";
}

std::string table_of(const Table& table) {
  if (table.columns.empty()) return "";
  std::string out = row_of(table.columns) + "|";
  for (std::size_t c = 0; c < table.columns.size(); ++c) out += " --- |";
  out += "\n";
  for (const auto& row : table.rows) out += row_of(row);
  return out + "\n";
}

Table correlation_table(const Result& result) {
  Table table{.title = "Correlation", .columns = {""}, .rows = {}};
  table.columns.insert(table.columns.end(), result.correlation_names.begin(), result.correlation_names.end());
  for (Eigen::Index i = 0; i < result.correlation.rows(); ++i) {
    std::vector<std::string> row{result.correlation_names.at(static_cast<std::size_t>(i))};
    for (Eigen::Index k = 0; k < result.correlation.cols(); ++k)
      row.push_back(format_number(result.correlation(i, k), 2));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string section_of(const Section& section, int level) {
  std::string out = heading(level, section.title);
  if (!section.text.empty()) out += escape_markdown(section.text) + "\n\n";
  for (const Table& table : section.tables) {
    if (!table.title.empty()) out += "**" + escape_markdown(table.title) + "**\n\n";
    out += table_of(table);
  }
  for (const Plot& plot : section.plots) {
    out += "*Figure: " + escape_markdown(plot.title) + "*";
    if (!plot.caption.empty()) out += " " + escape_markdown(plot.caption);
    out += "\n\n";
  }
  return out;
}

std::string chapter_of(const Result& result, int level) {
  std::string out = heading(level, title_of(result));
  if (!result.verdict.empty()) out += escape_markdown(result.verdict) + "\n\n";
  if (!result.parameters.empty()) out += heading(level + 1, "Parameters") + table_of(parameter_table(result));
  if (!result.warnings.empty()) {
    out += heading(level + 1, "Checks and warnings");
    for (const Warning& warning : result.warnings)
      out += "* **" + escape_markdown(warning.code) + "**: " + escape_markdown(warning.message) + "\n";
    out += "\n";
  }
  if (const Table fit = fit_table(result); !fit.rows.empty())
    out += heading(level + 1, "Fit") + table_of(fit);
  for (const Section& section : result.sections) out += section_of(section, level + 1);
  if (result.correlation.size() > 0)
    out += heading(level + 1, "Correlation") + table_of(correlation_table(result));
  return out + heading(level + 1, "Provenance") + table_of(provenance_table(result));
}

}  // namespace

std::string render_markdown(const Result& result) { return chapter_of(result, 1); }

std::string render_markdown(const std::string& title, std::span<const Result> results) {
  std::string out = heading(1, title);
  for (const Result& result : results) out += chapter_of(result, 2);
  return out;
}

}  // namespace ident
