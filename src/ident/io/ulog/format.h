// PX4 ULog as a log format.
#pragma once

#include <string>
#include <string_view>

#include "ident/data/log_streams.h"

namespace ident {

/// PX4 ULog, versions 0 and 1 [PX4 guide, "ULog File Format"]. A stream is `topic:instance`; times count from
/// the start that the header states. Damage is passed over as pyulog does, by the synchronisation bytes.
struct UlogFormat {
  static bool recognises(std::string_view first);
  /// Throws InputError where the file is cut within its header or needs a newer reader.
  static LogStreams read(std::string_view bytes, const std::string& file);
};

}  // namespace ident
