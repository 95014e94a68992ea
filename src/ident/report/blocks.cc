// Fills the tables that HTML, Markdown and terminal have in common.
#include "ident/report/blocks.h"

#include <algorithm>

#include "ident/core/format_number.h"
#include "ident/core/version.h"

namespace ident {
namespace {

bool any_parameter(const Result& result, auto has) { return std::ranges::any_of(result.parameters, has); }

std::string optional_number(const std::optional<double>& x, int digits) {
  return x ? format_number(*x, digits) : "";
}

std::string percent(const std::optional<double>& share) {
  return share ? format_number(100 * *share, 2) + " %" : "";
}

void add_leaves(const nlohmann::ordered_json& node, const std::string& name, Table& table) {
  if (node.is_object()) {
    for (const auto& [key, child] : node.items())
      add_leaves(child, name.empty() ? key : name + "." + key, table);
  } else if (node.is_number_float()) {
    table.rows.push_back({name, format_number(node.get<double>(), 5)});
  } else if (node.is_string()) {
    table.rows.push_back({name, node.get<std::string>()});
  } else if (node.is_null()) {
    table.rows.push_back({name, "–"});
  } else if (!node.is_array() || node.size() <= 8) {
    table.rows.push_back({name, node.dump()});
  }
}

std::string shell_quoted(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=:,+@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

Table parameter_table(const Result& result) {
  const bool naive = any_parameter(result, [](const Parameter& p) { return p.naive_std.has_value(); });
  const bool prior = any_parameter(result, [](const Parameter& p) { return p.prior_value.has_value(); });
  const bool share = any_parameter(result, [](const Parameter& p) { return p.from_flight.has_value(); });
  Table table{.title = "Parameters",
              .columns = {"Parameter", "Value", "Unit", "95 % interval", naive ? "Std (naive)" : "Std"},
              .rows = {}};
  if (prior) table.columns.insert(table.columns.end(), {"Prior", "Pull"});
  if (share) table.columns.emplace_back("From data");
  table.columns.insert(table.columns.end(), {"Source", "Identifiable"});
  for (const Parameter& p : result.parameters) {
    std::vector<std::string> row{p.name, format_rounded(p.value, p.std), p.unit,
                                 format_interval(p.ci95, p.value, p.std), format_number(p.std, 2)};
    if (p.naive_std) row.back() += " (" + format_number(*p.naive_std, 2) + ")";
    if (prior) {
      row.push_back(p.prior_value ? format_with_uncertainty(*p.prior_value, p.prior_std.value_or(kNaN)) : "");
      row.push_back(optional_number(p.pull, 2));
    }
    if (share) row.push_back(percent(p.from_flight));
    row.insert(row.end(), {p.source, p.identifiable ? "yes" : "no"});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table fit_table(const Result& result) {
  Table table{.title = "Fit", .columns = {"Quantity", "Value"}, .rows = {}};
  add_leaves(result.fit, "", table);
  return table;
}

Table provenance_table(const Result& result) {
  Table table{.title = "Provenance", .columns = {"What", "Value"}, .rows = {}};
  if (!result.command_line.empty()) table.rows.push_back({"command", command_line_of(result)});
  table.rows.push_back(
      {"version", "ident " + (result.version.empty() ? std::string(version()) : result.version)});
  if (result.seed) table.rows.push_back({"seed", std::to_string(*result.seed)});
  for (const InputFile& file : result.files) table.rows.push_back({file.path, "sha256 " + file.sha256});
  return table;
}

std::vector<std::string> not_identifiable(const Result& result) {
  std::vector<std::string> lines;
  for (const Parameter& p : result.parameters)
    if (!p.identifiable)
      lines.push_back(p.name + " is not identifiable" + (p.note.empty() ? "." : ": " + p.note));
  return lines;
}

std::vector<std::string> paragraphs_of(const std::string& text) {
  std::vector<std::string> paragraphs;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", at), text.size());
    if (end > at) paragraphs.push_back(text.substr(at, end - at));
    at = end + 2;
  }
  return paragraphs;
}

std::string title_of(const Result& result) {
  return result.command.empty() ? "ident" : "ident " + result.command;
}

std::string command_line_of(const Result& result) {
  std::string line;
  for (const std::string& word : result.command_line) line += (line.empty() ? "" : " ") + shell_quoted(word);
  return line;
}

}  // namespace ident
