// Any log of an autopilot, recognised by its first bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ident/data/log_streams.h"

namespace ident {

/// Name of the format of a file that begins with these bytes (up to `kRecognisedFrom` of them); empty where
/// it is none that is read.
std::string_view log_format(std::string_view first);
constexpr std::size_t kRecognisedFrom = 1 << 14;  // bytes; a text log may begin with the list of messages

/// Name of the format of a file; empty where it is none of them, or where the file cannot be opened.
std::string_view log_format_of_file(const std::string& path);

/// Reads a log. Throws InputError where the file is in no format that is read; one that has to be unpacked or
/// fetched first, or a telemetry log, is called that.
LogStreams read_log_streams(const std::string& path);

/// The same for the bytes of a file that is named in messages.
LogStreams read_log_streams(std::string_view bytes, const std::string& file);

std::vector<std::string> log_format_names();

}  // namespace ident
