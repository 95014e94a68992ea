// Finds profiles and lays a user's map over them.
#include "ident/io/log/profiles.h"

#include <algorithm>
#include <string>

#include "ident/core/error.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/log_signals.h"
#include "ident/io/log/profile_texts.h"
#include "ident/io/log/stream_signals.h"

namespace ident {
namespace {

/// How many signals of a map a log has.
long signals_in(const LogStreams& log, const LogMap& map) {
  return std::ranges::count_if(map.columns,
                               [&](const auto& line) { return has_signal(log, map, line.second); });
}

std::optional<LogMap> profile_of(const LogStreams& log) {
  std::optional<LogMap> best;
  long most = -1;
  for (const ProfileText& profile : profile_texts()) {
    LogMap map = parse_log_map(std::string(profile.text), "profile " + std::string(profile.name));
    if (std::ranges::find(map.formats, log.format) == map.formats.end()) continue;
    if (const long found = signals_in(log, map); found > most) most = found, best = std::move(map);
  }
  return best;
}

/// Two spellings of one thing: pulse widths and normalised commands, quaternion and angles.
std::string_view spelling(std::string_view signal) {
  if (signal.starts_with("delta")) return "delta";
  if (signal.starts_with("u")) return "u";
  if (signal == "phi" || signal == "theta" || signal == "psi") return "angles";
  if (signal.starts_with("q") && signal.size() == 2) return "quaternion";
  return {};
}

std::string_view other_spelling(std::string_view of) {
  if (of == "delta") return "u";
  if (of == "u") return "delta";
  if (of == "angles") return "quaternion";
  return of == "quaternion" ? "angles" : std::string_view();
}

/// The first of a line and its alternatives whose column is in the header.
std::optional<MappedColumn> in_header(const MappedColumn& line, const std::vector<std::string>& header) {
  if (line.stream.empty() && std::ranges::find(header, line.column) != header.end()) return line;
  for (const MappedColumn& other : line.otherwise)
    if (auto found = in_header(other, header)) return found;
  return std::nullopt;
}

void lay_over(LogMap& map, const LogMap& user) {
  for (const auto& [signal, column] : user.columns) {
    const std::string_view displaced = other_spelling(spelling(signal));
    if (!displaced.empty() && !column.column.empty())
      std::erase_if(map.columns, [&](const auto& line) { return spelling(line.first) == displaced; });
  }
  for (const auto& [signal, column] : user.columns) {
    map.columns[signal] = column;
    map.columns[signal].must_be_there = column.number == 0;
  }
  map.file = user.file;
  if (user.states_body) map.body = user.body;
  if (user.states_world) map.world = user.world;
  map.windows = user.windows;
  map.windows_line = user.windows_line;
  if (!user.airborne.empty()) map.airborne = user.airborne;
  if (!user.output_function.empty()) {
    map.output_function = user.output_function;
    map.motor_functions = user.motor_functions;
  }
}

}  // namespace

LogMap map_for_log(const LogStreams& log, const std::optional<LogMap>& user) {
  std::optional<LogMap> map = profile_of(log);
  if (!map && !user)
    throw UsageError("logs of the format '" + log.format +
                     "' have no profile: name streams and columns in a map (--map)");
  if (!map) map.emplace();
  if (user) lay_over(*map, *user);
  return *map;
}

std::optional<LogMap> map_for_header(const std::vector<std::string>& header) {
  for (const ProfileText& profile : profile_texts()) {
    LogMap map = parse_log_map(std::string(profile.text), "profile " + std::string(profile.name));
    std::map<std::string, MappedColumn> found;
    for (const auto& [signal, line] : map.columns)
      if (const auto column = in_header(line, header)) found[signal] = *column;
    if (std::ssize(found) - std::ranges::count(found, "t", [](const auto& line) { return line.first; }) < 2)
      continue;
    map.columns = std::move(found);
    return map;
  }
  return std::nullopt;
}

}  // namespace ident
