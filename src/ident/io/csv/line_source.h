// The lines of a text file of any size, with everything refused that is no text.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ident {

/// Lines without their end (LF, CR LF, CR CR LF), the byte order mark removed. Throws InputError on a read
/// error, NUL bytes, UTF-16, a git-LFS pointer, and on a line of more than 1 MiB.
class LineSource {
 public:
  explicit LineSource(const std::string& path);
  ~LineSource();
  LineSource(const LineSource&) = delete;
  LineSource& operator=(const LineSource&) = delete;

  /// The next line; valid until the next call.
  std::optional<std::string_view> next();
  /// Number of the line that `next` gave last, from 1.
  long line() const { return line_; }
  /// Whether the file's last line had an end; known after the last line.
  bool ended_with_newline() const;
  bool had_byte_order_mark() const;

 private:
  struct Reader;
  std::string path_;
  long line_ = 0;
  std::unique_ptr<Reader> reader_;
};

}  // namespace ident
