// A result for the terminal: verdict, parameters, what was not identified, findings.
#include "ident/report/text.h"

#include <fmt/format.h>

#include "ident/core/format_number.h"
#include "ident/report/blocks.h"
#include "ident/report/text_table.h"

namespace ident {
namespace {

constexpr std::size_t kLongTable = 24, kFirstRows = 10;
constexpr const char* kBold = "\033[1m";
constexpr const char* kYellow = "\033[33m";
constexpr const char* kPlain = "\033[0m";

std::string painted(const std::string& text, const char* colour, TextStyle style) {
  return style.colour ? colour + text + kPlain : text;
}

Table short_parameter_table(const Result& result) {
  Table table{.title = "", .columns = {"Parameter", "Value", "95 % interval", "Unit", "From"}, .rows = {}};
  for (const Parameter& p : result.parameters)
    table.rows.push_back({p.name + (p.identifiable ? "" : " ?"), format_rounded(p.value, p.std),
                          format_interval(p.ci95, p.value, p.std), p.unit, p.source});
  return table;
}

/// The first line of a table is its head.
std::string with_bold_head(const std::string& table, TextStyle style) {
  const auto end = table.find('\n');
  return painted(table.substr(0, end), kBold, style) + table.substr(end);
}

/// The first rows of a long table: what is listed last matters least.
std::string shortened_table(Table table, const std::string& section, TextStyle style) {
  const std::size_t rows = table.rows.size();
  if (rows > kLongTable) table.rows.resize(kFirstRows);
  std::string out = painted(table.title.empty() ? section : table.title, kBold, style) + "\n" +
                    text_table(table, style.width);
  if (rows > kLongTable) out += fmt::format("and {} more, which a report shows\n", rows - kFirstRows);
  return out + "\n";
}

}  // namespace

std::string render_text(const Result& result, TextStyle style) {
  std::string out = painted(title_of(result), kBold, style) + "\n\n";
  if (!result.verdict.empty()) out += wrap(result.verdict, style.width) + "\n";
  if (!result.parameters.empty() && !is_diagnosis(result)) {
    out += with_bold_head(text_table(short_parameter_table(result), style.width), style) + "\n";
    const std::vector<std::string> open_questions = not_identifiable(result);
    for (const std::string& line : open_questions) out += wrap("? " + line, style.width);
    if (!open_questions.empty()) out += "\n";
  }
  for (const Section& section : result.sections)
    for (const Table& table : section.tables)
      if (!is_data_health(section) && !table.rows.empty())
        out += shortened_table(table, section.title, style);
  for (const Findings& kind : findings_by_kind(result)) {
    out += painted("warning ", kYellow, style) + painted(kind.code, kBold, style) + "\n";
    for (const std::string& message : kind.messages) out += wrap(message, style.width, 2);
  }
  if (!result.warnings.empty()) out += "\n";
  return out;
}

}  // namespace ident
