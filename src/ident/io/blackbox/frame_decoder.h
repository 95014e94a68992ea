// Decodes the fields of one blackbox frame: encodings undone, predictions added.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ident/io/blackbox/byte_source.h"
#include "ident/io/blackbox/encodings.h"
#include "ident/io/blackbox/header.h"

namespace ident::blackbox {

/// Letters with which a frame begins: intra, inter, GPS, GPS home, event, slow.
constexpr bool is_frame_kind(std::uint8_t c) {
  return c == 'I' || c == 'P' || c == 'G' || c == 'H' || c == 'E' || c == 'S';
}

/// Numbers as in the header lines `H Field I predictor:`.
enum class Predictor : std::uint8_t {
  none = 0,
  previous = 1,
  straight_line = 2,
  average_of_2 = 3,
  min_throttle = 4,
  motor_0 = 5,
  increment = 6,
  home_coordinate = 7,
  constant_1500 = 8,
  vbat_reference = 9,
  last_main_time = 10,
  min_motor = 11,
};
inline constexpr int last_predictor = 11;

using Row = std::array<std::int64_t, max_fields>;

/// What predictions refer to besides the frame itself. Pointers are null where no valid frame came before.
struct Past {
  const Row* previous = nullptr;
  const Row* before_previous = nullptr;
  std::int64_t skipped = 0;  ///< iterations that were not logged on purpose since the previous frame
  std::array<std::int64_t, 2> home{};
  const Row* last_main = nullptr;
};

/// The steps to decode one kind of frame, prepared once for a log.
class FrameDecoder {
 public:
  FrameDecoder(const Header& header, const FrameDefinition& definition);

  /// Fields of the frame that begins at `in`. Where the bytes end, `in.past_end` is set and nothing is added
  /// to the predictions of the rest.
  void decode(ByteSource& in, const Past& past, Row& row) const;

  /// Bytes of a frame in which every number is as short as can be.
  std::size_t smallest_size() const;

 private:
  struct Step {
    Encoding encoding;
    std::uint8_t first;
    std::uint8_t count;
    bool counts_up;  ///< nothing is stored: the previous value plus one plus what was skipped
  };
  struct Field {
    Predictor predictor;
    bool is_signed;
    std::uint8_t home_axis;
  };

  std::int64_t predicted(std::size_t i, std::int64_t stored, const Past& past, const Row& row) const;
  void decode_group(ByteSource& in, const Step& step, const Past& past, Row& row) const;
  std::int64_t read_single(ByteSource& in, Encoding encoding) const;

  std::vector<Step> steps_;
  std::array<Field, max_fields> fields_{};
  int data_version_ = 0;
  std::int64_t min_throttle_ = 0;
  std::int64_t motor_low_ = 0;
  std::int64_t vbat_reference_ = 0;
  std::size_t motor_0_ = 0;
};

}  // namespace ident::blackbox
