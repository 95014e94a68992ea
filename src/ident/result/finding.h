// A named finding of a command.
#pragma once

#include <string>

namespace ident {

/// A named finding; the text says what was seen and what to do about it.
struct Warning {
  std::string code;
  std::string message;
};

}  // namespace ident
