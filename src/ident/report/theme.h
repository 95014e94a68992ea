// The colours of pages and pictures, light and dark.
#pragma once

#include <string>

namespace ident {

/// Style sheet of a page: colours by the reader's preference or his choice, always light on paper.
std::string page_style();

/// Style sheet inside a picture that is a file of its own.
std::string picture_style();

}  // namespace ident
