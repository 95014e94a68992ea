// Settings of a blackbox header as parameters and facts of a log.
#pragma once

#include "ident/data/log_streams.h"
#include "ident/io/blackbox/header.h"

namespace ident::blackbox {

/// Adds the header of log `number`. The first log's names stand alone, later logs add `2:name` where they
/// differ. `gyro_scale`, stored as the bits of a float, becomes its value in deg/s.
void add_settings(const Header& header, int number, LogStreams& streams);

}  // namespace ident::blackbox
