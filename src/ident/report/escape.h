// Text from files and users made harmless in HTML and Markdown.
#pragma once

#include <string>
#include <string_view>

namespace ident {

/// Safe as HTML text and in a quoted attribute; invalid UTF-8 becomes the replacement character.
std::string escape_html(std::string_view text);

/// Safe as a Markdown paragraph or table cell, on one line.
std::string escape_markdown(std::string_view text);

/// The UTF-8 text with every invalid byte and control character (but tab and newline) replaced.
std::string valid_utf8(std::string_view text);

}  // namespace ident
