// Chooses the form of a report by the ending of its file name.
#include <filesystem>

#include "ident/core/error.h"
#include "ident/report/report.h"
#include "ident/report/stored_result.h"

namespace ident {

ReportForm report_form(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".html" || ending == ".htm") return ReportForm::html;
  if (ending == ".md") return ReportForm::markdown;
  if (ending == ".json") return ReportForm::json;
  throw UsageError("'" + path + "': a report ends in .html, .md or .json");
}

std::string render_as(ReportForm form, const std::string& title, std::span<const Result> results) {
  if (form == ReportForm::markdown) return render_markdown(title, results);
  if (form == ReportForm::html) return render_html(title, results);
  nlohmann::ordered_json all{{"schema", "ident.campaign/1"}, {"title", title}};
  all["results"] = nlohmann::ordered_json::array();
  for (const Result& result : results) all["results"].push_back(stored_json(result));
  // File names may hold bytes that are no UTF-8: replaced, not refused.
  return all.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace ident
