// Finds the frames of one blackbox log, validates them and resynchronises after damage, as blackbox_decode
// does.
#include "ident/io/blackbox/log_decoder.h"

#include <algorithm>
#include <cstring>

namespace ident::blackbox {

namespace {

constexpr std::int64_t clock_turn = std::int64_t{1} << 32;  // us

}  // namespace

LogDecoder::LogDecoder(std::span<const std::uint8_t> log, const Header& header)
    : log_(log),
      header_(header),
      decode_I_(header, header.I),
      decode_P_(header, header.P),
      decode_S_(header, header.S),
      decode_G_(header, header.G),
      decode_H_(header, header.H),
      in_{log, header.data_begin},
      end_(log.size()) {}

void LogDecoder::run(FrameSink& sink) {
  constexpr std::uint8_t erased_flash = 0xff;
  while (in_.at < end_) {
    const std::uint8_t letter = log_[in_.at];
    if (letter == erased_flash)
      return sink.ends_early(in_.at, "erased flash (0xff) stands where a frame should begin");
    take_frame(letter, sink);
  }
  if (in_.past_end)
    sink.ends_early(end_,
                    "the last frame is cut off, its missing values are those that the decoder predicts");
  else if (!closed_)
    sink.ends_early(end_, "it was not closed");
}

void LogDecoder::take_frame(std::uint8_t letter, FrameSink& sink) {
  const std::size_t begin = in_.at++;
  if (!is_frame_kind(letter)) return lose_synchronisation(begin, sink);
  unknown_event_ = false;
  parse(static_cast<char>(letter));
  if (in_.at - begin - 1 > longest_frame) {
    ++in_.at;
    return lose_synchronisation(begin, sink);
  }
  complete(static_cast<char>(letter), sink);
}

void LogDecoder::lose_synchronisation(std::size_t byte, FrameSink& sink) {
  valid_ = false;
  sink.synchronisation_lost(byte, unknown_event_ ? LossCause::unknown_event : LossCause::damage);
}

void LogDecoder::parse(char kind) {
  Past past{.home = home_position_, .last_main = previous_};
  switch (kind) {
    case 'I':
      past.previous = past.before_previous = previous_;
      return decode_I_.decode(in_, past, rows_[current_]);
    case 'P':
      past.previous = previous_;
      past.before_previous = before_previous_;
      past.skipped = skipped_on_purpose();
      return decode_P_.decode(in_, past, rows_[current_]);
    case 'S':
      return decode_S_.decode(in_, past, slow_);
    case 'G':
      return decode_G_.decode(in_, past, gps_);
    case 'H':
      return decode_H_.decode(in_, past, home_);
    default:
      return parse_event();
  }
}

void LogDecoder::parse_event() {
  static constexpr char end_text[] = "End of log";  // stored with its final zero
  event_ = Event{static_cast<EventKind>(in_.byte())};
  switch (event_->kind) {
    case EventKind::sync_beep:
      event_->a = static_cast<double>(in_.unsigned_vb() + rollover_);
      return;
    case EventKind::adjustment: {
      const std::uint8_t function = in_.byte();
      event_->a = function & 0x7f;
      event_->b = function > 127 ? static_cast<double>(in_.float32()) : in_.signed_vb();
      return;
    }
    case EventKind::resume:
      event_->a = in_.unsigned_vb();
      event_->b = static_cast<double>(in_.unsigned_vb() + rollover_);
      return;
    case EventKind::end:
      if (in_.bytes.size() - in_.at >= sizeof end_text &&
          std::memcmp(in_.bytes.data() + in_.at, end_text, sizeof end_text) == 0) {
        in_.at += sizeof end_text;
        end_ = in_.at;
        closed_ = true;
        return;
      }
      in_.past_end = in_.bytes.size() - in_.at < sizeof end_text;
      in_.at += std::min(sizeof end_text, in_.bytes.size() - in_.at);
      event_.reset();  // bytes that happened to look like the end
      return;
    default:
      unknown_event_ = event_->kind == EventKind::disarm || event_->kind == EventKind::flight_mode;
      event_.reset();
  }
}

void LogDecoder::complete(char kind, FrameSink& sink) {
  switch (kind) {
    case 'I':
    case 'P':
      return complete_main(kind == 'I', sink);
    case 'S':
      return sink.slow_frame(slow_);
    case 'G':
      if (const int time = header_.G.find("time"); time >= 0) {
        std::int64_t& t = gps_[static_cast<std::size_t>(time)];
        t = unrolled_time(t);
      }
      if (home_is_known_) sink.gps_frame(gps_);
      return;
    case 'H':
      for (std::size_t axis = 0; axis < 2; ++axis)
        if (const int i = header_.H.find(axis == 0 ? "GPS_home[0]" : "GPS_home[1]"); i >= 0)
          home_position_[axis] = home_[static_cast<std::size_t>(i)];
      home_is_known_ = true;
      return;
    default:
      return complete_event(sink);
  }
}

void LogDecoder::complete_main(bool intra, FrameSink& sink) {
  Row& row = rows_[current_];
  row[1] = unrolled_time(row[1]);
  const bool believed = intra ? !last_iteration_ || plausible(row) : valid_ && plausible(row);
  if (!believed && (intra || valid_)) {
    valid_ = false;
    previous_ = before_previous_ = nullptr;
    sink.synchronisation_lost(in_.at, LossCause::damage);
  }
  if (!believed) return;
  valid_ = true;
  last_iteration_ = static_cast<std::uint32_t>(row[0]);
  last_time_ = row[1];
  sink.main_frame(row);
  // Nothing is predicted from before an intra frame.
  before_previous_ = intra ? &row : previous_;
  previous_ = &row;
  current_ = (current_ + 1) % 3;
}

void LogDecoder::complete_event(FrameSink& sink) {
  if (!event_) return;                      // bytes that happened to look like an event
  if (event_->kind == EventKind::resume) {  // the jump is then not taken for damage
    last_iteration_ = static_cast<std::uint32_t>(event_->a);
    last_time_ = static_cast<std::int64_t>(event_->b);
  }
  sink.event(*event_);
}

/// Adds the turns of the 32-bit clock: it turned if time went back by it, and forwards by little modulo 2^32.
std::int64_t LogDecoder::unrolled_time(std::int64_t time_us) {
  const auto low = static_cast<std::uint32_t>(time_us);
  if (last_time_) {
    const auto last = static_cast<std::uint32_t>(*last_time_);
    if (low < last && static_cast<std::uint32_t>(low - last) < longest_time_step) rollover_ += clock_turn;
  }
  return low + rollover_;
}

bool LogDecoder::plausible(const Row& row) const {
  const auto iteration = static_cast<std::uint32_t>(row[0]);
  const std::uint32_t last = last_iteration_.value_or(0xffffffffu);
  const std::int64_t last_time = last_time_.value_or(-1);
  return iteration >= last && iteration < last + longest_iteration_step && row[1] >= last_time &&
         row[1] < last_time + longest_time_step;
}

/// Iterations after the last frame that the settings leave out. An iteration i is logged if
///     (i mod I + numerator - 1) mod denominator < numerator.
std::int64_t LogDecoder::skipped_on_purpose() const {
  if (!last_iteration_) return 0;
  const std::int64_t interval = header_.interval_I;
  const std::int64_t numerator = header_.interval_P_numerator;
  const std::int64_t denominator = header_.interval_P_denominator;
  const std::int64_t in_interval = (std::int64_t{*last_iteration_} + 1) % interval;
  const std::int64_t phase = (in_interval + numerator - 1) % denominator;
  if (phase < numerator) return 0;
  return std::min(denominator - phase, (interval - in_interval) % interval);
}

}  // namespace ident::blackbox
