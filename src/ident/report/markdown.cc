// The Markdown twin of a report, for repositories: the same content in the same order.
#include "ident/report/markdown.h"

#include "ident/core/format_number.h"
#include "ident/report/blocks.h"
#include "ident/report/escape.h"
#include "ident/report/markdown.h"
#include "ident/report/plot_svg.h"

namespace ident {
namespace {

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
  Table table{.columns = {""}};
  table.columns.insert(table.columns.end(), result.correlation.names.begin(), result.correlation.names.end());
  for (Eigen::Index i = 0; i < result.correlation.matrix.rows(); ++i) {
    std::vector<std::string> row{result.correlation.names.at(static_cast<std::size_t>(i))};
    for (Eigen::Index k = 0; k < result.correlation.matrix.cols(); ++k)
      row.push_back(format_number(result.correlation.matrix(i, k), 2));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Letters, digits and hyphens of a name.
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (kept || (!out.empty() && out.back() != '-')) out += kept ? c : '-';
  }
  return out;
}

}  // namespace

void MarkdownWriter::heading(int level, const std::string& text) {
  text_ += std::string(static_cast<std::size_t>(level), '#') + " " + escape_markdown(text) + "\n\n";
}

void MarkdownWriter::paragraphs(const std::string& text) {
  for (const std::string& paragraph : paragraphs_of(text)) {
    const std::vector<std::string> lines = lines_of(paragraph);
    for (const std::string& line : lines)
      text_ += (lines.size() > 1 ? "* " : "") + escape_markdown(line) + "\n";
    text_ += "\n";
  }
}

std::string MarkdownWriter::picture_name(const std::string& chapter, const std::string& plot_id) {
  const std::string base = plain(chapter) + "-" + plain(plot_id);
  std::string name = base;
  for (int i = 2; !names_.insert(name).second; ++i) name = base + "-" + std::to_string(i);
  return name + ".svg";
}

void MarkdownWriter::figure(const Plot& plot, const std::string& chapter) {
  if (folder_.empty()) {
    text_ += "*Figure: " + escape_markdown(plot.title) + "*";
  } else {
    pictures_.push_back({picture_name(chapter, plot.id), standalone_svg(plot)});
    text_ += "**" + escape_markdown(plot.title) + "**\n\n![" + escape_markdown(plot.title) + "](<" + folder_ +
             "/" + pictures_.back().name + ">)\n\n";
  }
  if (!plot.caption.empty()) text_ += (folder_.empty() ? " " : "") + escape_markdown(plot.caption);
  text_ += "\n\n";
}

void MarkdownWriter::section(const Section& section, const std::string& chapter, int level) {
  heading(level, section.title);
  paragraphs(section.text);
  for (const Table& table : section.tables) {
    if (!table.title.empty()) text_ += "**" + escape_markdown(table.title) + "**\n\n";
    text_ += table_of(table);
  }
  for (const Plot& plot : section.plots) figure(plot, chapter);
}

void MarkdownWriter::parameters(const Result& result, int level) {
  if (result.parameters.empty()) return;
  heading(level, "Parameters");
  text_ += table_of(parameter_table(result));
  for (const std::string& line : not_identifiable(result)) text_ += "* " + escape_markdown(line) + "\n";
  text_ += "\n";
}

void MarkdownWriter::chapter(const Result& result, int level) {
  heading(level, title_of(result));
  paragraphs(verdict_of(result));
  if (!is_diagnosis(result)) parameters(result, level + 1);
  heading(level + 1, "Checks and warnings");
  for (const Findings& kind : findings_by_kind(result))
    for (const std::string& message : kind.messages)
      text_ += "* **" + escape_markdown(kind.code) + "**: " + escape_markdown(message) + "\n";
  text_ += result.warnings.empty() ? "No warnings.\n\n" : "\n";
  bool open = !result.correlation.empty();
  const auto correlation = [&] {
    if (!open) return;
    open = false;
    heading(level + 1, "Correlation");
    text_ += table_of(correlation_table(result));
  };
  for (const Section& part : sections_in_order(result)) {
    if (follows_correlation(part)) correlation();
    section(part, result.command, level + 1);
  }
  if (is_diagnosis(result)) parameters(result, level + 1);
  correlation();
  heading(level + 1, "Provenance");
  text_ += table_of(provenance_table(result));
}

std::string render_markdown(const Result& result) {
  MarkdownWriter writer;
  writer.chapter(result, 1);
  return writer.text();
}

std::string render_markdown(const std::string& title, std::span<const Result> results) {
  MarkdownWriter writer;
  writer.heading(1, title);
  for (const Result& result : results) writer.chapter(result, 2);
  return writer.text();
}

}  // namespace ident
