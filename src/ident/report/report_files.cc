// The files of a report, chosen by the ending of its name.
#include "ident/report/report_files.h"

#include <filesystem>

#include "ident/core/error.h"
#include "ident/core/version.h"
#include "ident/report/html.h"
#include "ident/report/markdown.h"
#include "ident/report/report_files.h"
#include "ident/report/stored_result.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

std::string json_text(const nlohmann::ordered_json& json) {
  // File names may hold bytes that are no UTF-8: replaced, not refused.
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

nlohmann::ordered_json json_with_sections(const Result& result) {
  nlohmann::ordered_json json = json_with_provenance(result);
  json["sections"] = stored_json(result).at("sections");
  return json;
}

/// report.md and the pictures in report_figures/ beside it.
template <typename Write>
std::vector<ReportFile> markdown_files(const fs::path& path, Write write) {
  const std::string folder = path.stem().string() + "_figures";
  MarkdownWriter writer(folder);
  write(writer);
  std::vector<ReportFile> files{{path.string(), writer.text()}};
  for (const MarkdownWriter::Picture& picture : writer.pictures())
    files.push_back({(path.parent_path() / folder / picture.name).string(), picture.svg});
  return files;
}

}  // namespace

nlohmann::ordered_json json_with_provenance(const Result& result) {
  nlohmann::ordered_json json = to_json(result);
  json["version"] = result.version.empty() ? version() : result.version;
  json["command_line"] = result.command_line;
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const InputFile& file : result.files) files.push_back({{"path", file.path}, {"sha256", file.sha256}});
  json["files"] = files;
  return json;
}

ReportForm report_form(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".html" || ending == ".htm") return ReportForm::html;
  if (ending == ".md") return ReportForm::markdown;
  if (ending == ".json") return ReportForm::json;
  throw UsageError("'" + path + "': a report ends in .html, .md or .json");
}

std::vector<ReportFile> report_files(const std::string& path, const Result& result) {
  const ReportForm form = report_form(path);
  if (form == ReportForm::html) return {{path, render_html(result)}};
  if (form == ReportForm::json) return {{path, json_text(json_with_sections(result))}};
  return markdown_files(path, [&](MarkdownWriter& writer) { writer.chapter(result, 1); });
}

std::vector<ReportFile> report_files(const std::string& path, const std::string& title,
                                     std::span<const Result> results) {
  const ReportForm form = report_form(path);
  if (form == ReportForm::html) return {{path, render_html(title, results)}};
  if (form == ReportForm::markdown)
    return markdown_files(path, [&](MarkdownWriter& writer) {
      writer.heading(1, title);
      for (const Result& result : results) writer.chapter(result, 2);
    });
  nlohmann::ordered_json all{{"schema", "ident.campaign/1"}, {"title", title}};
  all["results"] = nlohmann::ordered_json::array();
  for (const Result& result : results) all["results"].push_back(json_with_sections(result));
  return {{path, json_text(all)}};
}

}  // namespace ident
