// Text of the errors with a place in a file.
#include "ident/core/error.h"

#include <fmt/format.h>

namespace ident {
namespace {

std::string placed(std::string_view file, long line, std::string_view column, std::string_view what) {
  std::string text(file);
  if (line > 0) text += fmt::format(":{}", line);
  text += ": ";
  if (!column.empty()) text += fmt::format("{}: ", column);
  return text.append(what);
}

}  // namespace

InputError::InputError(std::string_view file, long line, std::string_view column, std::string_view what)
    : Error(ExitStatus::bad_input, placed(file, line, column, what)) {}

}  // namespace ident
