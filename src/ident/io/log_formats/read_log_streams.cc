// Tries the formats that are registered, and refuses what is none of them.
#include "ident/io/log_formats/read_log_streams.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "ident/core/error.h"
#include "ident/io/file/whole_file.h"
#include "ident/io/log_formats/all_formats.h"
#include "ident/io/log_formats/refusals.h"

namespace ident {
namespace {

struct Format {
  std::string_view name;
  bool (*recognises)(std::string_view first);
  LogStreams (*read)(std::string_view bytes, const std::string& file);
};

constexpr auto kFormats = std::to_array<Format>({
#define IDENT_LOG_FORMAT(name, header, Type) {#name, &Type::recognises, &Type::read},
#include "ident/io/log_formats/log_formats.def"
#undef IDENT_LOG_FORMAT
});

const Format* find_format(std::string_view first) {
  first = first.substr(0, kRecognisedFrom);
  for (const Format& format : kFormats)
    if (format.recognises(first)) return &format;
  return nullptr;
}

}  // namespace

std::string_view log_format(std::string_view first) {
  const Format* format = find_format(first);
  return format ? format->name : std::string_view();
}

std::string_view log_format_of_file(const std::string& path) {
  return log_format(first_bytes(path, kRecognisedFrom));
}

LogStreams read_log_streams(const std::string& path) { return read_log_streams(whole_file(path), path); }

LogStreams read_log_streams(std::string_view bytes, const std::string& file) {
  if (const Format* format = find_format(bytes)) return format->read(bytes, file);
  refuse_no_log(bytes.substr(0, kRecognisedFrom), file);
  throw InputError(
      file, 0, "",
      fmt::format("is in no format of a log that is read: {}", fmt::join(log_format_names(), ", ")));
}

std::vector<std::string> log_format_names() {
  std::vector<std::string> names;
  for (const Format& format : kFormats) names.emplace_back(format.name);
  return names;
}

}  // namespace ident
