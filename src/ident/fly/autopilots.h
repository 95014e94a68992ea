// The list of autopilots.
#pragma once

#include "ident/fly/autopilot.h"

namespace ident {

/// All of autopilots.def, in its order.
std::span<const AutopilotInfo> autopilots();

/// Throws UsageError, with the nearest name, for an autopilot that is not in the list.
const AutopilotInfo& find_autopilot(const std::string& name);

}  // namespace ident
