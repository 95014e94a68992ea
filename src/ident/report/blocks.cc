// Fills the tables that HTML, Markdown and terminal have in common.
#include "ident/report/blocks.h"

#include <fmt/format.h>

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

constexpr std::size_t kFewNumbers = 8;  // of an object or list that a digest shows

/// Single numbers and small groups of them; what is many or deep stands in sections of its own.
void add_leaves(const nlohmann::ordered_json& node, const std::string& name, Table& table) {
  const auto deep = [](const auto& child) { return child.is_structured(); };
  if (node.is_object()) {
    if (!name.empty() && (node.size() > kFewNumbers || std::ranges::any_of(node, deep))) return;
    for (const auto& [key, child] : node.items())
      add_leaves(child, name.empty() ? key : fmt::format("{}.{}", name, key), table);
  } else if (node.is_number_float()) {
    table.rows.push_back({name, format_number(node.get<double>(), 5)});
  } else if (node.is_string()) {
    table.rows.push_back({name, node.get<std::string>()});
  } else if (node.is_null()) {
    table.rows.push_back({name, "–"});
  } else if (!node.is_array() || (node.size() <= kFewNumbers && std::ranges::none_of(node, deep))) {
    table.rows.push_back({name, node.dump()});
  }
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

/// What a command without a verdict of its own has found.
std::string identified(const Result& result) {
  std::vector<std::string> found;
  for (const Parameter& p : result.parameters)
    if (p.identifiable)
      found.push_back(p.name + " = " + format_with_uncertainty(p.value, p.std) +
                      (p.unit == "-" ? "" : " " + p.unit));
  return found.empty() ? "" : joined(found, ", ") + ".";
}

constexpr const char* kHealth = "Data health";

/// How the files were read, for a command that says nothing about the health of its data itself.
Section files_as_read(const nlohmann::ordered_json& notices) {
  Section health{.title = kHealth};
  for (const auto& notice : notices)
    health.text += (health.text.empty() ? "" : "\n") + notice.get<std::string>();
  return health;
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
  const bool sources =
      any_parameter(result, [&](const Parameter& p) { return p.source != result.parameters.front().source; });
  Table table{.title = "Parameters",
              .columns = {"Parameter", "Value", "Unit", "95 % interval", naive ? "Std (naive)" : "Std"},
              .rows = {}};
  if (prior) table.columns.insert(table.columns.end(), {"Prior", "Pull"});
  if (share) table.columns.emplace_back("From data");
  if (sources) table.columns.emplace_back("Source");
  table.columns.emplace_back("Identifiable");
  for (const Parameter& p : result.parameters) {
    std::vector<std::string> row{p.name, format_rounded(p.value, p.std), p.unit,
                                 format_interval(p.ci95, p.value, p.std), format_number(p.std, 2)};
    if (p.naive_std) row.back() += " (" + format_number(*p.naive_std, 2) + ")";
    if (prior) {
      row.push_back(p.prior_value ? format_with_uncertainty(*p.prior_value, p.prior_std.value_or(kNaN)) : "");
      row.push_back(optional_number(p.pull, 2));
    }
    if (share) row.push_back(percent(p.from_flight));
    if (sources) row.push_back(p.source);
    row.push_back(p.identifiable ? "yes" : "no");
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
  std::vector<std::pair<std::string, std::vector<std::string>>> by_reason;
  for (const Parameter& p : result.parameters) {
    if (p.identifiable) continue;
    auto at = std::ranges::find(by_reason, p.note, [](const auto& entry) { return entry.first; });
    if (at == by_reason.end()) at = by_reason.insert(at, {p.note, {}});
    at->second.push_back(p.name);
  }
  std::vector<std::string> lines;
  for (const auto& [reason, names] : by_reason)
    lines.push_back(joined(names, ", ") + (names.size() == 1 ? " is" : " are") + " not identifiable" +
                    (reason.empty() ? "." : ": " + reason));
  return lines;
}

bool is_data_health(const Section& section) { return section.title == kHealth; }

std::string verdict_of(const Result& result) {
  std::string text = result.verdict.empty() ? identified(result) : result.verdict;
  const std::vector<Findings> findings = findings_by_kind(result);
  if (findings.empty() || text.empty()) return text;
  std::vector<std::string> kinds;
  for (const Findings& kind : findings) kinds.push_back(kind.code);
  return text + " To look at: " + joined(kinds, ", ") + ".";
}

std::vector<Findings> findings_by_kind(const Result& result) {
  std::vector<Findings> kinds;
  for (const Warning& warning : result.warnings) {
    auto at = std::ranges::find(kinds, warning.code, &Findings::code);
    if (at == kinds.end()) at = kinds.insert(at, {warning.code, {}});
    at->messages.push_back(warning.message);
  }
  return kinds;
}

bool follows_correlation(const Section& section) {
  return section.title.starts_with("Profile likelihood") || section.title.starts_with("Held-out");
}

std::vector<Section> sections_in_order(const Result& result) {
  std::vector<Section> health, rest;
  for (const Section& section : result.sections) (is_data_health(section) ? health : rest).push_back(section);
  if (health.empty() && result.extra.contains("notices"))
    health.push_back(files_as_read(result.extra.at("notices")));
  if (const Table fit = fit_table(result); !fit.rows.empty())
    health.push_back({.title = "Fit", .tables = {{.columns = fit.columns, .rows = fit.rows}}});
  const bool data_first = !is_diagnosis(result);
  rest.insert(data_first ? rest.begin() : rest.end(), health.begin(), health.end());
  return rest;
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

std::vector<std::string> lines_of(const std::string& paragraph) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < paragraph.size();) {
    const std::size_t end = std::min(paragraph.find('\n', at), paragraph.size());
    if (end > at) lines.push_back(paragraph.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

bool is_diagnosis(const Result& result) { return result.schema == "ident.gap/1"; }

std::string title_of(const Result& result) {
  const bool refined = std::ranges::count(result.command_line, "--refine") > 0;
  return "ident" + (result.command.empty() ? "" : " " + result.command) + (refined ? " --refine" : "");
}

std::string command_line_of(const Result& result) {
  std::string line;
  for (const std::string& word : result.command_line)
    line += line.empty() ? shell_quoted(word.substr(word.find_last_of('/') + 1)) : " " + shell_quoted(word);
  return line;
}

}  // namespace ident
