// Temporary file, fsync, rename; a lock on the temporary file tells the living from the stale.
#include "ident/io/file/write_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "ident/core/error.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".ident-tmp";

[[noreturn]] void fail(const std::string& path, std::string_view what, int error) {
  throw OutputError(fmt::format("{}: {}: {}", path, what, std::strerror(error)));
}

void write_all(int fd, std::string_view content, const std::string& path) {
  while (!content.empty()) {
    const ssize_t wrote = ::write(fd, content.data(), content.size());
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) fail(path, "cannot be written", errno);
    content.remove_prefix(static_cast<std::size_t>(wrote));
  }
}

/// Start of the names of all temporary files of one target.
std::string stem_of(const fs::path& target) {
  constexpr std::size_t kLongest = 200;  // a file name has at most 255 bytes
  return "." + target.filename().string().substr(0, kLongest) + ".";
}

fs::path folder_of(const fs::path& target) {
  return target.parent_path().empty() ? fs::path(".") : target.parent_path();
}

/// Removes temporary files of this target that nobody holds a lock on.
void clean_stale(const fs::path& target) {
  const std::string stem = stem_of(target);
  std::error_code ignored;
  for (fs::directory_iterator at(folder_of(target), ignored), end; !ignored && at != end;
       at.increment(ignored)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with(stem) || !name.ends_with(kSuffix)) continue;
    const int fd = ::open(at->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (fd < 0) continue;
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0) ::unlink(at->path().c_str());
    ::close(fd);
  }
}

bool is_special(const std::string& path) {
  struct stat info;
  return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

/// The file behind symbolic links, so that a link stays a link.
fs::path behind_links(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  return error ? fs::path(path) : real;
}

}  // namespace

void require_folder_of(const std::string& path) {
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error))
    throw OutputError(fmt::format("{}: there is no folder {} to write it into", path, folder.string()));
}

struct Outputs::Pending {
  std::string path, content;
  fs::path target, temporary;
  int fd = -1;

  Pending(std::string where, std::string what) : path(std::move(where)), content(std::move(what)) {}
  ~Pending() { drop(); }
  Pending(const Pending&) = delete;
  Pending& operator=(const Pending&) = delete;

  void drop() {
    if (fd < 0) return;
    ::unlink(temporary.c_str());
    ::close(fd);
    fd = -1;
  }

  void open() {
    static std::atomic<int> count = 0;
    for (int attempt = 0; attempt < 100; ++attempt) {
      temporary = folder_of(target) / fmt::format("{}{}-{}{}", stem_of(target), ::getpid(), ++count, kSuffix);
      fd = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (fd < 0 && errno == EEXIST) continue;
      if (fd < 0) fail(path, "cannot be created", errno);
      // Another process that cleans up may have taken the file between the two calls.
      struct stat info;
      if (::flock(fd, LOCK_EX | LOCK_NB) == 0 && ::fstat(fd, &info) == 0 && info.st_nlink > 0) return;
      ::close(fd);
      fd = -1;
    }
    throw OutputError(path + ": no name for a temporary file is free");
  }

  void prepare() {
    if (fd >= 0 || is_special(path)) return;
    target = behind_links(path);
    struct stat info;
    const bool exists = ::stat(target.c_str(), &info) == 0;
    if (exists && S_ISDIR(info.st_mode)) throw OutputError(path + ": is a folder");
    if (exists && ::access(target.c_str(), W_OK) != 0) fail(path, "cannot be written", errno);
    clean_stale(target);
    open();
    if (exists) (void)::fchmod(fd, info.st_mode & 07777);  // best effort: the content matters
    write_all(fd, content, path);
    if (::fsync(fd) != 0) fail(path, "cannot be written", errno);
  }

  void commit() {
    if (is_special(path)) return write_directly();
    if (::rename(temporary.c_str(), target.c_str()) != 0) fail(path, "cannot be put in place", errno);
    ::close(fd);
    fd = -1;
    const int folder = ::open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    ::fsync(folder);
    ::close(folder);
  }

  void write_directly() const {
    const int device = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (device < 0) fail(path, "cannot be opened", errno);
    try {
      write_all(device, content, path);
    } catch (...) {
      ::close(device);
      throw;
    }
    ::close(device);
  }
};

Outputs::Outputs() = default;
Outputs::~Outputs() = default;

void Outputs::add(const std::string& path, std::string content) {
  std::erase_if(pending_, [&](const auto& p) { return p->path == path; });
  pending_.push_back(std::make_unique<Pending>(path, std::move(content)));
}

const std::string* Outputs::find(const std::string& path) const {
  const auto at = std::ranges::find_if(pending_, [&](const auto& p) { return p->path == path; });
  return at == pending_.end() ? nullptr : &(*at)->content;
}

void Outputs::prepare() {
  for (const auto& output : pending_) output->prepare();
}

void Outputs::commit() {
  prepare();
  for (const auto& output : pending_) output->commit();
  pending_.clear();
}

void write_whole(const std::string& path, std::string_view content) {
  Outputs outputs;
  outputs.add(path, std::string(content));
  outputs.commit();
}

}  // namespace ident
