// Whole small files, and what is not text at all.
#include "ident/io/file/read_bytes.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>

#include "ident/core/error.h"

namespace ident {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kLfsPointer = "version https://git-lfs.github.com/spec/";

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> starts) {
  for (const std::string_view start : starts)
    if (text.starts_with(start)) return true;
  return false;
}

}  // namespace

std::string byte_order_mark(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string first(kByteOrderMark.size(), ' ');
  return file.read(first.data(), static_cast<std::streamsize>(first.size())) && first == kByteOrderMark
             ? first
             : std::string();
}

void refuse_no_text(const std::string& path, std::string_view first) {
  const auto refuse = [&](std::string_view what) { throw InputError(path, 1, "", what); };
  if (first.starts_with(kLfsPointer))
    refuse("is a git-LFS pointer, not the data: fetch them with 'git lfs pull'");
  if (starts_with_any(first, {"\xFF\xFE", "\xFE\xFF"}))
    refuse("is UTF-16 text: save it as UTF-8 (for example with 'iconv -f UTF-16 -t UTF-8')");
  if (starts_with_any(first, {"\x1F\x8B", "PK\x03\x04",
                              "\xFD"
                              "7zXZ",
                              "BZh"}))
    refuse("is compressed: unpack it first");
  if (starts_with_any(first, {std::string_view("\x55\x4c\x6f\x67\x01\x12\x35", 7), "\xA3\x95", "\x89MCAP"}))
    refuse("is a binary flight log, not a table: 'ident log' says what is in it");
  if (first.substr(0, first.find('\n')).find('\0') != std::string_view::npos)
    refuse("holds NUL bytes: a binary file or UTF-16, no text");
}

std::string read_bytes(const std::string& path, std::size_t limit) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw InputError(path, 0, "", fmt::format("cannot be opened: {}", std::strerror(errno)));
  struct stat info;
  if (::fstat(::fileno(file.get()), &info) == 0 && S_ISDIR(info.st_mode))
    throw InputError(path, 0, "", "is a folder");
  std::string bytes;
  char part[1 << 14];
  while (const std::size_t got = std::fread(part, 1, sizeof part, file.get())) {
    bytes.append(part, got);
    if (bytes.size() > limit) throw InputError(path, 0, "", "is too large for a file of this kind");
  }
  if (std::ferror(file.get())) throw InputError(path, 0, "", "cannot be read");
  refuse_no_text(path, bytes);
  if (const std::size_t nul = bytes.find('\0'); nul != std::string::npos)
    throw InputError(path, 1 + std::count(bytes.begin(), bytes.begin() + static_cast<long>(nul), '\n'), "",
                     "holds a NUL byte: a binary file");
  if (bytes.starts_with(kByteOrderMark)) bytes.erase(0, kByteOrderMark.size());
  return bytes;
}

}  // namespace ident
