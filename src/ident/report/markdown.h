// The writer behind the Markdown report: text, and the pictures that it shows.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "ident/report/report.h"
#include "ident/result/result.h"

namespace ident {

class MarkdownWriter {
 public:
  /// Pictures are shown from `folder`, relative to the report; with none they are only named.
  explicit MarkdownWriter(std::string folder = "") : folder_(std::move(folder)) {}

  void heading(int level, const std::string& text);
  void chapter(const Result& result, int level);
  const std::string& text() const { return text_; }

  struct Picture {
    std::string name;  ///< in the folder
    std::string svg;
  };
  const std::vector<Picture>& pictures() const { return pictures_; }

 private:
  void paragraphs(const std::string& text);
  void parameters(const Result& result, int level);
  void section(const Section& section, const std::string& chapter, int level);
  void figure(const Plot& plot, const std::string& chapter);
  std::string picture_name(const std::string& chapter, const std::string& plot_id);

  std::string folder_, text_;
  std::vector<Picture> pictures_;
  std::set<std::string> names_;
};

/// The same content for repositories. Pictures are named, not shown; `report_files` shows them.
std::string render_markdown(const Result& result);

std::string render_markdown(const std::string& title, std::span<const Result> results);

}  // namespace ident
