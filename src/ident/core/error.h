// The errors that a user can repair, each with the exit status of the program it leads to.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace ident {

/// Exit status of the program, see "Exit status" in notebooks/guide/formats.md.
enum class ExitStatus : int { done = 0, data_do_not_allow = 1, bad_input = 2, cannot_write = 6 };

/// Base of all errors for which the message is meant for the user.
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& message) : std::runtime_error(message), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// Wrong options or arguments.
struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(ExitStatus::bad_input, message) {}
};

/// A file that cannot be read or understood: `file:line: column: what is wrong`. Line 0 and an empty
/// column mean "the file as a whole".
struct InputError : Error {
  InputError(std::string_view file, long line, std::string_view column, std::string_view what);
};

/// The input is well formed, but the data do not determine what was asked for.
struct DataError : Error {
  explicit DataError(const std::string& message) : Error(ExitStatus::data_do_not_allow, message) {}
};

/// An output could not be written; what stood there before is untouched.
struct OutputError : Error {
  explicit OutputError(const std::string& message) : Error(ExitStatus::cannot_write, message) {}
};

}  // namespace ident
