// Collects the frames of one blackbox log as streams: `1:main`, `1:slow`, `1:gps`, `1:events`.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "ident/data/log_streams.h"
#include "ident/io/blackbox/charge_counter.h"
#include "ident/io/blackbox/column_store.h"
#include "ident/io/blackbox/log_decoder.h"

namespace ident::blackbox {

/// A row of the main stream is a line of blackbox_decode's CSV: main frame, charge, and the last slow frame.
class LogRecorder : public FrameSink {
 public:
  LogRecorder(const Header& header, ChargeCounter& charge);

  void main_frame(const Row& row) override;
  void slow_frame(const Row& row) override;
  void gps_frame(const Row& row) override;
  void event(const Event& event) override;
  void synchronisation_lost(std::size_t byte, LossCause cause) override;
  void ends_early(std::size_t byte, std::string_view reason) override;

  std::size_t main_frames() const { return main_.rows(); }
  /// Adds the streams of log `number`. Times count from `clock_zero_us` of the log's clock plus `begin`
  /// seconds. Returns the time of the last main frame.
  double add_to(LogStreams& streams, int number, double begin);
  /// Clock of the first main frame [us].
  std::int64_t first_time_us() const { return first_time_us_; }

 private:
  double seconds(std::int64_t time_us) const { return 1e-6 * static_cast<double>(time_us - first_time_us_); }
  void add_stream(LogStreams& streams, std::string name, std::string clock, std::vector<double>& times,
                  std::vector<StreamField> fields, double begin) const;

  const Header& header_;
  ChargeCounter& charge_;
  int amperage_ = -1;
  int gps_time_ = -1;
  ColumnStore main_, slow_, gps_;
  std::vector<double> main_t_, slow_t_, gps_t_, event_t_;
  std::vector<std::uint8_t> event_kinds_;
  std::vector<double> event_a_, event_b_;
  Row last_slow_{};
  std::int64_t first_time_us_ = 0;
  std::int64_t last_time_us_ = 0;
  bool gap_open_ = false;  ///< synchronisation was lost since the last main frame
  std::vector<std::array<double, 2>> gaps_;
  std::size_t losses_ = 0;
  std::size_t first_loss_ = 0;
  std::string early_end_;
};

}  // namespace ident::blackbox
