// The HTML page of a result: text and tables here, pictures from the plot files.
#include "ident/report/assets.h"
#include "ident/report/blocks.h"
#include "ident/report/escape.h"
#include "ident/report/report.h"

namespace ident {
namespace {

std::string heading(int level, const std::string& text) {
  const std::string tag = "h" + std::to_string(level);
  return "<" + tag + ">" + escape_html(text) + "</" + tag + ">\n";
}

std::string paragraph(const std::string& text, const std::string& css_class = "") {
  if (text.empty()) return "";
  return "<p" + (css_class.empty() ? "" : " class=\"" + css_class + "\"") + ">" + escape_html(text) +
         "</p>\n";
}

std::string table_of(const Table& table, const std::string& caption) {
  if (table.columns.empty()) return "";
  std::string out = "<div class=\"scroll\"><table>";
  if (!caption.empty()) out += "<caption>" + escape_html(caption) + "</caption>";
  out += "<thead><tr>";
  for (const std::string& name : table.columns) out += "<th scope=\"col\">" + escape_html(name) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c)
      out += c == 0 ? "<th scope=\"row\">" + escape_html(row[c]) + "</th>"
                    : "<td>" + escape_html(row[c]) + "</td>";
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string warnings_of(const Result& result) {
  if (result.warnings.empty()) return "<p class=\"none\">No warnings.</p>\n";
  std::string out = "<ul class=\"warnings\">\n";
  for (const Warning& warning : result.warnings)
    out += "<li><span class=\"code\">" + escape_html(warning.code) + "</span> " +
           escape_html(warning.message) + "</li>\n";
  return out + "</ul>\n";
}

std::string section_of(const Section& section, int level) {
  std::string out = "<section>" + heading(level, section.title) + paragraph(section.text);
  for (const Table& table : section.tables) out += table_of(table, table.title);
  return out + "</section>\n";
}

std::string chapter_of(const Result& result, int level) {
  std::string out = "<article>" + heading(level, title_of(result)) + paragraph(result.verdict, "verdict");
  if (!result.parameters.empty())
    out += heading(level + 1, "Parameters") + table_of(parameter_table(result), "");
  out += heading(level + 1, "Checks and warnings") + warnings_of(result);
  if (const Table fit = fit_table(result); !fit.rows.empty())
    out += heading(level + 1, "Fit") + table_of(fit, "");
  for (const Section& section : result.sections) out += section_of(section, level + 1);
  out += heading(level + 1, "Provenance") + table_of(provenance_table(result), "");
  return out + "</article>\n";
}

std::string page_of(const std::string& title, const std::string& body) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      escape_html(title) + "</title>\n<style>\n";
  out += kPageStyle;
  return out + "</style>\n</head>\n<body><div class=\"frame\"><main>\n" + body +
         "</main></div></body>\n</html>\n";
}

}  // namespace

std::string render_html(const Result& result) { return page_of(title_of(result), chapter_of(result, 1)); }

std::string render_html(const std::string& title, std::span<const Result> results) {
  std::string body = heading(1, title);
  for (const Result& result : results) body += chapter_of(result, 2);
  return page_of(title, body);
}

}  // namespace ident
