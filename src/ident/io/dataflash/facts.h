// What a DataFlash log tells beside its streams: parameters and messages in words.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "ident/data/log_streams.h"

namespace ident::dataflash {

class Facts {
 public:
  explicit Facts(LogStreams& log) : log_(log) {}

  /// The first value of a parameter is that at the start; another one later is a change at `t`, s.
  void take_parameter(std::string_view name, double value, std::optional<double> t);
  /// Keeps the firmware (`ArduCopter V4.3.6 (0c5e999c)`), the frame and the board.
  void take_message(std::string_view text);

 private:
  LogStreams& log_;
  std::map<std::string, double, std::less<>> now_;  ///< parameters as they were set last
};

}  // namespace ident::dataflash
