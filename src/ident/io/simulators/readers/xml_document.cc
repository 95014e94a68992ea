// Places in an XML file: parsed in situ without changing a byte of texts and attributes.
#include "ident/io/simulators/readers/xml_document.h"

#include <algorithm>
#include <cstring>

#include "ident/core/error.h"

namespace ident {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

long line_of(const std::string& text, std::ptrdiff_t offset) {
  const auto end =
      text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text.size()));
  return 1 + std::count(text.begin(), end, '\n');
}

void collect(pugi::xml_node node, std::string_view name, std::vector<pugi::xml_node>& found, int depth) {
  if (depth > 200) return;  // no model is nested like this; keeps the stack safe
  for (const pugi::xml_node child : node.children()) {
    if (child.name() == name) found.push_back(child);
    collect(child, name, found, depth + 1);
  }
}

}  // namespace

XmlDocument::XmlDocument(const std::string& text, const std::string& file)
    : text_(text), file_(file), buffer_(text.begin(), text.end()) {
  const pugi::xml_parse_result parsed =
      document_.load_buffer_inplace(buffer_.data(), buffer_.size(), pugi::parse_minimal, pugi::encoding_utf8);
  if (!parsed)
    throw InputError(file, line_of(text, parsed.offset), "",
                     std::string("is not valid XML: ") + parsed.description());
}

long XmlDocument::line(pugi::xml_node node) const { return line_of(text_, node.offset_debug()); }

void XmlDocument::fail(pugi::xml_node node, std::string_view what) const {
  throw InputError(file_, line(node), node.name(), what);
}

XmlDocument::Span XmlDocument::trimmed(const char* text) const {
  const std::string_view all(text);
  const std::size_t first = all.find_first_not_of(kBlank);
  const std::size_t begin = static_cast<std::size_t>(text - buffer_.data());
  if (first == std::string_view::npos) return {begin, 0};
  return {begin + first, all.find_last_not_of(kBlank) + 1 - first};
}

void XmlDocument::add_numbers(Fields& fields, const std::string& name, pugi::xml_node element) const {
  if (!element) return;
  const pugi::xml_text text = element.text();
  if (text.empty()) fail(element, "has no value");
  const Span span = trimmed(text.get());
  if (span.size == 0) fail(element, "has no value");
  fields.add_numbers(name, span.begin, span.size);
}

void XmlDocument::add_numbers(Fields& fields, const std::string& name, pugi::xml_attribute attribute) const {
  if (!attribute) return;
  const Span span = trimmed(attribute.value());
  fields.add_numbers(name, span.begin, span.size);
}

void XmlDocument::add_word(Fields& fields, const std::string& name, pugi::xml_node element) const {
  if (!element || element.text().empty()) return;
  const Span span = trimmed(element.text().get());
  fields.add_word(name, span.begin, span.size);
}

void XmlDocument::can_insert_behind(Fields& fields, const std::string& name, pugi::xml_node sibling,
                                    const std::string& tag, double absent) const {
  const std::string closing = std::string("</") + sibling.name() + ">";
  const std::size_t start = static_cast<std::size_t>(sibling.offset_debug());
  const std::size_t end = text_.find(closing, start);
  if (end == std::string::npos) return;
  const std::size_t line_start = text_.rfind('\n', start) + 1;  // npos + 1 is 0
  const std::size_t indent = text_.find_first_not_of(" \t", line_start);
  fields.can_insert(name, {.at = end + closing.size(),
                           .before = "\n" + text_.substr(line_start, indent - line_start) + "<" + tag + ">",
                           .after = "</" + tag + ">",
                           .absent = absent});
}

std::vector<pugi::xml_node> elements_below(pugi::xml_node node, std::string_view name) {
  std::vector<pugi::xml_node> found;
  collect(node, name, found, 0);
  return found;
}

}  // namespace ident
