// Decodes the fields of one blackbox frame: encodings undone, predictions added.
#include "ident/io/blackbox/frame_decoder.h"

#include <algorithm>

namespace ident::blackbox {

namespace {

/// Damaged files let predictions run away: sums wrap instead of being undefined.
std::int64_t wrapping_sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

std::int64_t wrapping_line(std::int64_t previous, std::int64_t before) {
  return static_cast<std::int64_t>(2 * static_cast<std::uint64_t>(previous) -
                                   static_cast<std::uint64_t>(before));
}

}  // namespace

FrameDecoder::FrameDecoder(const Header& header, const FrameDefinition& definition)
    : data_version_(header.data_version),
      min_throttle_(header.min_throttle),
      motor_low_(header.motor_low),
      vbat_reference_(header.vbat_reference),
      motor_0_(static_cast<std::size_t>(std::max(0, header.I.find("motor[0]")))) {
  const std::size_t n = definition.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto predictor = static_cast<Predictor>(definition.predictor[i]);
    // Latitude and longitude share the predictor: the second of two neighbours is the longitude.
    const bool second_of_pair = i > 0 && predictor == Predictor::home_coordinate &&
                                fields_[i - 1].predictor == Predictor::home_coordinate &&
                                fields_[i - 1].home_axis == 0;
    fields_[i] = {predictor, definition.is_signed[i] != 0,
                  second_of_pair ? std::uint8_t{1} : std::uint8_t{0}};
  }
  for (std::size_t i = 0; i < n;) {
    const auto encoding = static_cast<Encoding>(definition.encoding[i]);
    const bool counts_up = fields_[i].predictor == Predictor::increment;
    std::size_t count = counts_up ? 1 : static_cast<std::size_t>(fields_of_group(encoding));
    if (count == 0)
      while (count < 8 && i + count < n && definition.encoding[i + count] == definition.encoding[i]) ++count;
    count = std::min(count, n - i);
    steps_.push_back({encoding, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(count), counts_up});
    i += count;
  }
}

std::size_t FrameDecoder::smallest_size() const {
  return static_cast<std::size_t>(std::count_if(steps_.begin(), steps_.end(), [](const Step& step) {
    return !step.counts_up && step.encoding != Encoding::null;
  }));
}

std::int64_t FrameDecoder::predicted(std::size_t i, std::int64_t stored, const Past& past,
                                     const Row& row) const {
  switch (fields_[i].predictor) {
    case Predictor::none:
    case Predictor::increment:
      return stored;
    case Predictor::previous:
      return past.previous ? wrapping_sum(stored, (*past.previous)[i]) : stored;
    case Predictor::straight_line:
      return past.previous
                 ? wrapping_sum(stored, wrapping_line((*past.previous)[i], (*past.before_previous)[i]))
                 : stored;
    case Predictor::average_of_2:
      return past.previous
                 ? wrapping_sum(stored, wrapping_sum((*past.previous)[i], (*past.before_previous)[i]) / 2)
                 : stored;
    case Predictor::min_throttle:
      return wrapping_sum(stored, min_throttle_);
    case Predictor::motor_0:
      return wrapping_sum(stored, row[motor_0_]);
    case Predictor::home_coordinate:
      return wrapping_sum(stored, past.home[fields_[i].home_axis]);
    case Predictor::constant_1500:
      return wrapping_sum(stored, 1500);
    case Predictor::vbat_reference:
      return wrapping_sum(stored, vbat_reference_);
    case Predictor::last_main_time:
      return past.last_main ? wrapping_sum(stored, (*past.last_main)[1]) : stored;
    case Predictor::min_motor:
      return wrapping_sum(stored, motor_low_);
  }
  return stored;
}

void FrameDecoder::decode_group(ByteSource& in, const Step& step, const Past& past, Row& row) const {
  Group values{};
  switch (step.encoding) {
    case Encoding::tag8_8svb:
      read_tag8_8svb(in, step.count, values);
      break;
    case Encoding::tag2_3s32:
      read_tag2_3s32(in, values);
      break;
    case Encoding::tag2_3s_variable:
      read_tag2_3s_variable(in, values);
      break;
    default:
      if (data_version_ < 2)
        read_tag8_4s16_v1(in, values);
      else
        read_tag8_4s16_v2(in, values);
  }
  for (std::size_t j = 0; j < step.count; ++j)
    row[step.first + j] = predicted(step.first + j, values[j], past, row);
}

std::int64_t FrameDecoder::read_single(ByteSource& in, Encoding encoding) const {
  switch (encoding) {
    case Encoding::signed_vb:
      return in.signed_vb();
    case Encoding::unsigned_vb:
      return in.unsigned_vb();
    case Encoding::negative_14_bit:
      return read_negative_14_bit(in);
    default:
      return 0;
  }
}

void FrameDecoder::decode(ByteSource& in, const Past& past, Row& row) const {
  for (const Step& step : steps_) {
    const std::size_t i = step.first;
    if (step.counts_up) {
      row[i] = wrapping_sum(past.skipped + 1, past.previous ? (*past.previous)[i] : 0);
      continue;
    }
    switch (step.encoding) {
      case Encoding::tag8_8svb:
      case Encoding::tag2_3s32:
      case Encoding::tag2_3s_variable:
      case Encoding::tag8_4s16:
        decode_group(in, step, past, row);
        break;
      default: {
        const std::int64_t value = predicted(i, read_single(in, step.encoding), past, row);
        // Numbers stored singly have 32 bits; those of groups keep what their prediction makes of them.
        row[i] = fields_[i].is_signed ? std::int64_t{static_cast<std::int32_t>(value)}
                                      : std::int64_t{static_cast<std::uint32_t>(value)};
      }
    }
  }
}

}  // namespace ident::blackbox
