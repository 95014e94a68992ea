// Reads files of any content and size at once.
#include "ident/io/file/whole_file.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "ident/core/error.h"

namespace ident {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open(const std::string& path) { return {std::fopen(path.c_str(), "rb"), &std::fclose}; }

std::size_t read_into(std::string& bytes, std::size_t at, std::FILE* file) {
  return std::fread(bytes.data() + at, 1, bytes.size() - at, file);
}

}  // namespace

std::string whole_file(const std::string& path) {
  const File file = open(path);
  if (!file) throw InputError(path, 0, "", fmt::format("cannot be opened: {}", std::strerror(errno)));
  struct stat info;
  if (::fstat(::fileno(file.get()), &info) != 0 || S_ISDIR(info.st_mode))
    throw InputError(path, 0, "", "is a folder");
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  constexpr std::size_t kPart = 1 << 20;  // bytes, for what has no size, as a pipe
  const bool has_size = S_ISREG(info.st_mode) && info.st_size > 0;
  std::string bytes(has_size ? static_cast<std::size_t>(info.st_size) : kPart, '\0');
  std::size_t filled = 0;
  while (const std::size_t got = read_into(bytes, filled, file.get())) {
    filled += got;
    if (filled < bytes.size()) continue;
    if (has_size) break;
    bytes.resize(2 * bytes.size());
  }
  if (std::ferror(file.get())) throw InputError(path, 0, "", "cannot be read");
  bytes.resize(filled);
  return bytes;
}

std::string first_bytes(const std::string& path, std::size_t count) {
  struct stat info;
  if (::stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return {};
  const File file = open(path);
  if (!file) return {};
  std::string bytes(count, '\0');
  bytes.resize(std::fread(bytes.data(), 1, count, file.get()));
  return bytes;
}

}  // namespace ident
