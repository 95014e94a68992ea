// The text header of a blackbox log: the fields of each kind of frame, and the settings that decoding needs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ident::blackbox {

/// Fields that a frame can have in blackbox_decode, whose limit is the format's.
inline constexpr std::size_t max_fields = 128;

/// The fields of one kind of frame (`I`, `P`, `S`, `G`, `H`), as its header lines state them.
struct FrameDefinition {
  std::vector<std::string> names;
  std::array<int, max_fields> is_signed{};
  std::array<int, max_fields> predictor{};
  std::array<int, max_fields> encoding{};

  std::size_t size() const { return names.size(); }
  /// Index of a field; -1 where there is none.
  int find(std::string_view name) const;
};

/// What the header of one log states. Defaults are those of blackbox_decode.
struct Header {
  std::vector<std::pair<std::string, std::string>> lines;  ///< `name:value`, in the order of the file
  FrameDefinition I, P, S, G, H;
  int data_version = 0;
  int min_throttle = 1150;  ///< us
  int motor_low = 1150;     ///< lowest value of `motor[]`, from `motorOutput`
  int vbat_reference = 4095;
  int interval_I = 32;             ///< loop iterations between I frames
  int interval_P_numerator = 1;    ///< logged share of the iterations, from `P interval:1/2`
  int interval_P_denominator = 1;  ///< the newer `P interval:16` leaves 1/1, as blackbox_decode does
  std::size_t data_begin = 0;      ///< byte of the log at which frames begin
  bool reaches_data = false;       ///< false where the file ends within the header

  std::string_view value(std::string_view name) const;
};

/// Reads header lines from the first byte of a log to its first frame. Never fails: what is missing keeps its
/// default.
Header read_header(std::span<const std::uint8_t> log);

}  // namespace ident::blackbox
