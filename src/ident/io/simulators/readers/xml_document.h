// An XML file through pugixml, with the place of every text and attribute in the file.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "ident/io/simulators/fields.h"

namespace ident {

/// Parsed in a copy of the text, so that pointers into it are places in the file.
class XmlDocument {
 public:
  /// Throws InputError `file:line` when it is no XML.
  XmlDocument(const std::string& text, const std::string& file);
  XmlDocument(const XmlDocument&) = delete;
  XmlDocument& operator=(const XmlDocument&) = delete;

  pugi::xml_node root() const { return document_.document_element(); }
  long line(pugi::xml_node node) const;
  [[noreturn]] void fail(pugi::xml_node node, std::string_view what) const;

  /// Adds the numbers of an element's text, or of an attribute; nothing happens where there is none.
  void add_numbers(Fields& fields, const std::string& name, pugi::xml_node element) const;
  void add_numbers(Fields& fields, const std::string& name, pugi::xml_attribute attribute) const;
  void add_word(Fields& fields, const std::string& name, pugi::xml_node element) const;
  /// A new element `tag` would stand behind `sibling`, on a line of its own; `absent` is what holds without
  /// it.
  void can_insert_behind(Fields& fields, const std::string& name, pugi::xml_node sibling,
                         const std::string& tag, double absent) const;

 private:
  struct Span {
    std::size_t begin, size;
  };
  Span trimmed(const char* text) const;

  std::string text_, file_;
  std::vector<char> buffer_;
  pugi::xml_document document_;
};

/// All elements of that name below a node, in the order of the file.
std::vector<pugi::xml_node> elements_below(pugi::xml_node node, std::string_view name);

}  // namespace ident
