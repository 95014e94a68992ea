// What a PX4 log says about itself: formats of topics (release 1.15), information and parameters.
#pragma once

#include "case.h"
#include "ulog_file.h"

namespace written {

void put_px4_facts(UlogFile& log, const Flight& flight, const Logging& logging);

}  // namespace written
