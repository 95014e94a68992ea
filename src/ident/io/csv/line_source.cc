// Lines through fast-cpp-csv-parser's LineReader, on a byte source of our own. The library takes a read error
// for the end of the file, drops what follows a NUL byte, and repeats rows where a large file lacks its last
// newline.
#include "ident/io/csv/line_source.h"

#ifndef __clang__  // the library cuts long file names on purpose
#pragma GCC diagnostic ignored "-Wstringop-truncation"
#endif
#include <libfccp/csv.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "ident/core/error.h"
#include "ident/io/file/read_bytes.h"

namespace ident {
namespace {

constexpr std::size_t kLongestLine = 1u << 20;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

[[noreturn]] void refuse_long_line(const std::string& path, long line) {
  throw InputError(path, line, "", "is longer than 1 MiB: no table, or its line ends are missing");
}

/// What is learnt of a file while its bytes pass. The reader owns the source; this outlives it.
struct Seen {
  bool byte_order_mark = false;
  bool ended_with_newline = true;
};

class CheckedBytes : public io::ByteSourceBase {
 public:
  CheckedBytes(std::string path, std::shared_ptr<Seen> seen)
      : path_(std::move(path)), seen_(std::move(seen)), file_(std::fopen(path_.c_str(), "rb"), &std::fclose) {
    if (!file_) fail("cannot be opened", errno);
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  }

  /// Fills the whole buffer unless the file ends: fewer bytes mean the end to the library.
  int read(char* buffer, int size) override {
    const std::size_t room = static_cast<std::size_t>(size);
    std::size_t got = 0;
    while (got < room && !std::feof(file_.get())) {
      got += std::fread(buffer + got, 1, room - got, file_.get());
      if (std::ferror(file_.get())) fail("cannot be read", errno);
    }
    if (got > 0) check({buffer, got});
    if (got < room && last_ != '\n') buffer[got++] = last_ = '\n';
    return static_cast<int>(got);
  }

 private:
  [[noreturn]] void fail(std::string_view what, int error) const {
    throw InputError(path_, 0, "", std::string(what) + ": " + std::strerror(error));
  }

  // By memchr: std::count looks at one byte after the other, a tenth of the time of reading a log.
  static long newlines(std::string_view bytes) {
    long count = 0;
    for (std::size_t at = bytes.find('\n'); at != std::string_view::npos; at = bytes.find('\n', at + 1))
      ++count;
    return count;
  }

  void check(std::string_view bytes) {
    if (first_) {
      refuse_no_text(path_, bytes.substr(0, 64));
      seen_->byte_order_mark = bytes.starts_with(kByteOrderMark);
      first_ = false;
    }
    const std::size_t nul = bytes.find('\0');
    if (nul != std::string_view::npos)
      throw InputError(path_, line_ + newlines(bytes.substr(0, nul)), "",
                       "holds a NUL byte: a binary file, or a log that was cut off");
    line_ += newlines(bytes);
    last_ = bytes.back();
    seen_->ended_with_newline = last_ == '\n';
  }

  std::string path_;
  std::shared_ptr<Seen> seen_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  long line_ = 1;
  char last_ = '\n';
  bool first_ = true;
};

}  // namespace

struct LineSource::Reader {
  std::shared_ptr<Seen> seen = std::make_shared<Seen>();
  io::LineReader lines;
  explicit Reader(const std::string& path) : lines(path, std::make_unique<CheckedBytes>(path, seen)) {}
};

LineSource::LineSource(const std::string& path) : path_(path), reader_(std::make_unique<Reader>(path)) {}
LineSource::~LineSource() = default;

std::optional<std::string_view> LineSource::next() {
  char* text = nullptr;
  try {
    text = reader_->lines.next_line();
  } catch (const io::error::line_length_limit_exceeded&) {
    refuse_long_line(path_, line_ + 1);
  }
  if (text == nullptr) return std::nullopt;
  ++line_;
  std::string_view line(text);
  while (line.ends_with('\r')) line.remove_suffix(1);  // CR CR LF, of text that was written as text twice
  if (line.size() > kLongestLine) refuse_long_line(path_, line_);
  return line;
}

bool LineSource::ended_with_newline() const { return reader_->seen->ended_with_newline; }
bool LineSource::had_byte_order_mark() const { return reader_->seen->byte_order_mark; }

}  // namespace ident
