// Clocks of topics and the version of the firmware.
#include "ident/io/ulog/conventions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace ident::ulog {

std::string_view clock_of(const LogStream& stream) {
  const StreamField* sample = stream.find("timestamp_sample");
  const StreamField* published = stream.find("timestamp");
  if (!sample || !published) return sample ? "timestamp_sample" : "timestamp";
  const auto* counts = std::get_if<std::vector<std::uint64_t>>(&sample->values);
  const bool set = counts && std::ranges::all_of(*counts, [](std::uint64_t c) { return c > 0; });
  return set ? "timestamp_sample" : "timestamp";
}

void name_firmware(LogStreams& log) {
  const auto at = log.facts.find("ver_sw_release");
  unsigned long release = 0;
  if (at == log.facts.end() || std::sscanf(at->second.c_str(), "%lu", &release) != 1) return;
  log.facts["firmware"] = fmt::format("{} v{}.{}.{}", log.facts["sys_name"], release >> 24 & 0xFF,
                                      release >> 16 & 0xFF, release >> 8 & 0xFF);
}

}  // namespace ident::ulog
