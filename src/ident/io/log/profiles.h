// Maps that the project ships for the logs of autopilots.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "ident/io/log/read_flight_log.h"

namespace ident {

/// A file of data/profiles, which is part of the library.
struct ProfileText {
  std::string_view name, text;
};
std::span<const ProfileText> profile_texts();

/// The profile of a format with a user's map laid over it line by line: a signal that the user names, or says
/// is not to be read, is his. Without a profile the user's map alone. Throws UsageError where there is
/// neither.
LogMap map_for_format(std::string_view format, const std::optional<LogMap>& user);

}  // namespace ident
