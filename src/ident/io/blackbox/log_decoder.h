// Finds the frames of one blackbox log, validates them and resynchronises after damage, as blackbox_decode
// does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "ident/io/blackbox/frame_decoder.h"
#include "ident/io/blackbox/header.h"

namespace ident::blackbox {

/// Numbers of the events that are understood.
enum class EventKind : std::uint8_t {
  sync_beep = 0,
  adjustment = 13,
  resume = 14,
  disarm = 15,
  flight_mode = 30,
  end = 255
};

/// One event frame. `a` and `b` are: beep time in us; adjusted function and new value; iteration and time in
/// us of the first frame after a pause; new and old flight mode flags.
struct Event {
  EventKind kind = EventKind::end;
  double a = 0.0;
  double b = 0.0;
};

/// Events that blackbox_decode does not know (disarming, change of flight mode) cost it the frames after
/// them.
enum class LossCause : std::uint8_t { damage, unknown_event };

/// Takes the frames of one log in the order of the file. Only valid frames are given.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void main_frame(const Row& row) = 0;
  virtual void slow_frame(const Row& row) = 0;
  virtual void gps_frame(const Row& row) = 0;
  virtual void event(const Event& event) = 0;
  /// Main frames are not valid from here to the next intra frame. `byte` counts from the start of the log.
  virtual void synchronisation_lost(std::size_t byte, LossCause cause) = 0;
  /// The log stops at `byte` without the event that closes it.
  virtual void ends_early(std::size_t byte, std::string_view reason) = 0;
};

/// Longest frame that is believed, without its letter [B], as in blackbox_decode.
inline constexpr std::size_t longest_frame = 256;
/// Largest steps between two valid main frames [us, iterations], as in blackbox_decode.
inline constexpr std::int64_t longest_time_step = 10'000'000;
inline constexpr std::uint32_t longest_iteration_step = 5000;

/// Decodes one log. A frame is what follows its letter and is believed if its values go on from those before;
/// a byte that is no letter is passed over, and main frames then count again from the next intra frame. A
/// last frame that is cut off is kept: what is missing is as predicted. The byte 0xff in place of a letter
/// (erased flash) ends the log. All of this is what blackbox_decode (of betaflight/blackbox-tools) does: its
/// output is what users compare with.
class LogDecoder {
 public:
  LogDecoder(std::span<const std::uint8_t> log, const Header& header);
  void run(FrameSink& sink);

 private:
  void take_frame(std::uint8_t letter, FrameSink& sink);
  void parse(char kind);
  void parse_event();
  void complete(char kind, FrameSink& sink);
  void complete_main(bool intra, FrameSink& sink);
  void complete_event(FrameSink& sink);
  void lose_synchronisation(std::size_t byte, FrameSink& sink);
  std::int64_t unrolled_time(std::int64_t time_us);
  bool plausible(const Row& row) const;
  std::int64_t skipped_on_purpose() const;

  std::span<const std::uint8_t> log_;
  const Header& header_;
  FrameDecoder decode_I_, decode_P_, decode_S_, decode_G_, decode_H_;
  ByteSource in_;
  std::size_t end_ = 0;

  Row rows_[3]{};  ///< ring: being decoded, the two before it
  std::size_t current_ = 0;
  const Row* previous_ = nullptr;
  const Row* before_previous_ = nullptr;
  bool valid_ = false;
  std::optional<std::uint32_t> last_iteration_;
  std::optional<std::int64_t> last_time_;
  std::int64_t rollover_ = 0;  ///< whole turns of the 32-bit clock [us]
  Row slow_{}, gps_{}, home_{};
  std::array<std::int64_t, 2> home_position_{};
  bool home_is_known_ = false;
  std::optional<Event> event_;
  bool unknown_event_ = false;  ///< the bytes that follow belong to an event that was not understood
  bool closed_ = false;         ///< the event at the end of a log was read
};

}  // namespace ident::blackbox
