// The HTML page of a result: headings, tables and pictures in the order in which they are read.
#include "ident/report/html.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/report/assets.h"
#include "ident/report/blocks.h"
#include "ident/report/escape.h"
#include "ident/report/heat_map.h"
#include "ident/report/html_table.h"
#include "ident/report/plot_data.h"
#include "ident/report/plot_svg.h"
#include "ident/report/theme.h"

namespace ident {
namespace {

std::string paragraphs(const std::string& text, const std::string& attributes = "") {
  std::string out;
  for (const std::string& paragraph : paragraphs_of(text)) {
    const std::vector<std::string> lines = lines_of(paragraph);
    if (lines.size() == 1) {
      out += "<p" + attributes + ">" + html_text(paragraph) + "</p>\n";
      continue;
    }
    out += "<ul class=\"lines\">\n";
    for (const std::string& line : lines) out += "<li>" + html_text(line) + "</li>\n";
    out += "</ul>\n";
  }
  return out;
}

// From so many plots on, those that need no width stand two side by side.
constexpr std::ptrdiff_t kManyPlots = 4;

bool fits_half(const Plot& plot) { return plot.kind == Plot::Kind::xy && plot.column_names.empty(); }

/// Collects body, table of contents and plot data while a page is written.
class Page {
 public:
  void heading(int level, const std::string& text) {
    const std::string id = fmt::format("part{}", ++parts_);
    body_ += fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", level, id, html_text(text));
    if (level > 1 && level < 4)
      contents_ +=
          fmt::format("<li class=\"level{}\"><a href=\"#{}\">{}</a></li>\n", level, id, html_text(text));
  }
  void add(const std::string& html) { body_ += html; }

  void figure(const Plot& plot, const std::string& group, PlotWidth width = PlotWidth::whole) {
    const std::string id = fmt::format("figure{}", ++figures_);
    const char* half = width == PlotWidth::half ? " class=\"half\"" : "";
    body_ +=
        fmt::format("<figure id=\"{}\"{}><figcaption><strong>{}</strong>", id, half, html_text(plot.title));
    if (!plot.caption.empty()) body_ += "<span>" + html_text(plot.caption) + "</span>";
    body_ += "</figcaption>\n";
    const std::string picture = "<div class=\"picture\">" + plot_svg(plot, id, width) + "</div>";
    if (plot.kind == Plot::Kind::time_series && !kPlotLibrary.empty())
      body_ += fmt::format("<div class=\"chart\" data-plot=\"{}\">{}</div>", data_.add(plot, group), picture);
    else
      body_ += picture;
    body_ += "</figure>\n";
  }

  void section(const Section& section, int level) {
    body_ += "<section>";
    heading(level, section.title);
    body_ += paragraphs(section.text);
    for (const Table& table : section.tables) body_ += html_table(table, table.title);
    const std::string group = fmt::format("group{}", parts_);
    const bool many = std::ranges::count_if(section.plots, fits_half) >= kManyPlots;
    for (const Plot& plot : section.plots)
      figure(plot, group, many && fits_half(plot) ? PlotWidth::half : PlotWidth::whole);
    body_ += "</section>\n";
  }

  void parameters(const Result& result, int level);
  void chapter(const Result& result, int level);
  std::string finish(const std::string& title) const;

 private:
  std::string body_, contents_;
  PlotData data_;
  int parts_ = 0, figures_ = 0;
};

std::string warnings_of(const Result& result) {
  if (result.warnings.empty()) return "<p class=\"none-found\">No warnings.</p>\n";
  std::string out = "<ul class=\"warnings\">\n";
  for (const Findings& kind : findings_by_kind(result)) {
    out += "<li><b>" + escape_html(kind.code) + "</b>";
    for (const std::string& message : kind.messages) out += " <span>" + html_text(message) + "</span>";
    out += "</li>\n";
  }
  return out + "</ul>\n";
}

void Page::parameters(const Result& result, int level) {
  if (result.parameters.empty()) return;
  heading(level, "Parameters");
  add(html_table(parameter_table(result), ""));
  for (const std::string& line : not_identifiable(result)) add(paragraphs(line, " class=\"open\""));
}

void Page::chapter(const Result& result, int level) {
  heading(level, title_of(result));
  add(paragraphs(verdict_of(result), " class=\"verdict\""));
  if (!is_diagnosis(result)) parameters(result, level + 1);
  heading(level + 1, "Checks and warnings");
  add(warnings_of(result));
  bool open = !result.correlation.empty();
  const auto correlation = [&] {
    if (!open) return;
    open = false;
    heading(level + 1, "Correlation");
    figure(correlation_plot(result), "");
  };
  for (const Section& part : sections_in_order(result)) {
    if (follows_correlation(part)) correlation();
    section(part, level + 1);
  }
  if (is_diagnosis(result)) parameters(result, level + 1);
  correlation();
  heading(level + 1, "Provenance");
  add(verbatim_table(provenance_table(result)));
}

std::string Page::finish(const std::string& title) const {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  out +=
      "<title>" + escape_html(title) + "</title>\n<style>\n" + page_style() + "</style>\n</head>\n<body>\n";
  out += "<button id=\"theme\" type=\"button\" hidden>Dark</button>\n<div class=\"frame\">\n";
  out += "<nav aria-label=\"Contents\"><details id=\"contents\"><summary>Contents</summary><ol>\n" +
         contents_ + "</ol></details></nav>\n";
  out += "<main>\n" + body_ + "</main>\n</div>\n";
  if (!data_.empty()) {
    out += "<script type=\"application/json\" id=\"plot-data\">" + data_.json() + "</script>\n<script>";
    out += kPlotLibrary;
    out += "</script>\n";
  }
  out += "<script>\n";
  out += kPageScript;
  return out + "</script>\n</body>\n</html>\n";
}

}  // namespace

std::string render_html(const Result& result) {
  Page page;
  page.chapter(result, 1);
  return page.finish(title_of(result));
}

std::string render_html(const std::string& title, std::span<const Result> results) {
  Page page;
  page.heading(1, title);
  for (const Result& result : results) page.chapter(result, 2);
  return page.finish(title);
}

}  // namespace ident
