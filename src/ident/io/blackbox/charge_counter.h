// The column `energyCumulative (mAh)` that blackbox_decode adds to main frames, to compare with its output.
#pragma once

#include <cmath>
#include <cstdint>

namespace ident::blackbox {

/// Sums up currents as blackbox_decode does: numbers in 0.01 A are taken for those of a 12-bit converter,
/// each is held back by one frame, the clock has 32 bits, and the sum runs on through the logs of a file. So
/// it is the consumption of no battery; profiles do not use it.
class ChargeCounter {
 public:
  /// `currentMeter:offset,scale` of the header; 0 and 400 without it.
  void set_meter(int offset_mV, int scale) {
    offset_mV_ = offset_mV;
    scale_ = scale == 0 ? 1 : scale;
  }
  /// The log's frames begin again: its first is counted at time -1 us.
  void begin_log() { last_frame_time_ = -1; }

  std::int64_t charge_mAh(std::int64_t amperage, std::int64_t time_us) {
    const std::int64_t converted_mV =
        static_cast<std::uint16_t>(amperage) * std::int64_t{3300} / 4095 - offset_mV_;
    const auto current_mA = static_cast<std::int16_t>(converted_mV * 10000 / scale_);
    const auto now = static_cast<std::uint32_t>(last_frame_time_);
    constexpr double us_per_hour = 3.6e9;
    if (last_counted_ != 0)
      sum_mAh_ +=
          static_cast<double>(current_mA) * static_cast<std::uint32_t>(now - last_counted_) / us_per_hour;
    last_counted_ = now;
    last_frame_time_ = time_us;
    return std::lround(sum_mAh_);
  }

 private:
  int offset_mV_ = 0;
  int scale_ = 400;
  std::int64_t last_frame_time_ = -1;
  std::uint32_t last_counted_ = 0;
  double sum_mAh_ = 0.0;
};

}  // namespace ident::blackbox
