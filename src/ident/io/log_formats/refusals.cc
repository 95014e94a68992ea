// Recognises what is no log, or none that can be used.
#include "ident/io/log_formats/refusals.h"

#include <array>
#include <cstdint>

#include "ident/core/error.h"

namespace ident {
namespace {

struct Packed {
  std::string_view magic, name, command;
};
constexpr std::array<Packed, 6> kPacked = {{{"\x1F\x8B", "a gzip file", "gunzip"},
                                            {"PK\x03\x04", "a zip archive", "unzip"},
                                            {"\x28\xB5\x2F\xFD", "a zstd file", "unzstd"},
                                            {"\xFD"
                                             "7zXZ",
                                             "an xz file", "unxz"},
                                            {"BZh", "a bzip2 file", "bunzip2"},
                                            {"\x04\x22\x4D\x18", "an lz4 file", "unlz4"}}};

/// Microseconds since 1970, big endian, before each packet of MAVLink 1 or 2.
bool is_telemetry_log(std::string_view first) {
  constexpr std::uint64_t kFrom = 946684800000000, kUntil = 4102444800000000;  // us: the years 2000 and 2100
  if (first.size() < 9) return false;
  std::uint64_t time = 0;
  for (std::size_t i = 0; i < 8; ++i) time = time << 8 | static_cast<unsigned char>(first[i]);
  return (first[8] == '\xFE' || first[8] == '\xFD') && time >= kFrom && time < kUntil;
}

}  // namespace

void refuse_no_log(std::string_view first, const std::string& file) {
  const auto refuse = [&](const std::string& what) { throw InputError(file, 0, "", what); };
  for (const auto& [magic, name, command] : kPacked)
    if (first.starts_with(magic))
      refuse("is " + std::string(name) + ": unpack it first ('" + std::string(command) + "')");
  if (first.starts_with("version https://git-lfs"))
    refuse("is a git-LFS pointer, not the data: fetch them with 'git lfs pull'");
  if (is_telemetry_log(first))
    refuse(
        "is a telemetry log (MAVLink), whose 2 to 4 Hz are too slow: take the log on the vehicle's card, "
        ".ulg of "
        "PX4 or .bin of ArduPilot, which the ground station fetches under 'log download'");
}

}  // namespace ident
