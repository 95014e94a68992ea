// What PX4 means by the names of fields and facts, beyond the format of the file.
#pragma once

#include <string_view>

#include "ident/data/log_streams.h"

namespace ident::ulog {

/// The field that tells the instant of the sample, where the topic states it, else that of its publication.
std::string_view clock_of(const LogStream& stream);

/// Adds the fact `firmware`, as `PX4 v1.15.0`, from ver_sw_release: major, minor, patch and type, a byte
/// each.
void name_firmware(LogStreams& log);

}  // namespace ident::ulog
