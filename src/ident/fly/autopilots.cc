// The list of autopilots, out of autopilots.def.
#include "ident/fly/autopilots.h"

#include <fmt/format.h>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"

namespace ident {

#define IDENT_AUTOPILOT(name) AutopilotInfo name##_autopilot();
#include "ident/fly/autopilots.def"
#undef IDENT_AUTOPILOT

std::span<const AutopilotInfo> autopilots() {
  static const std::vector<AutopilotInfo> list = {
#define IDENT_AUTOPILOT(name) name##_autopilot(),
#include "ident/fly/autopilots.def"
#undef IDENT_AUTOPILOT
  };
  return list;
}

const AutopilotInfo& find_autopilot(const std::string& name) {
  std::vector<std::string> names;
  std::string known;
  for (const AutopilotInfo& info : autopilots()) {
    if (info.name == name) return info;
    names.emplace_back(info.name);
    known += (known.empty() ? "" : " ") + names.back();
  }
  throw UsageError(
      fmt::format("unknown autopilot '{}'{} (known: {})", name, did_you_mean(name, names), known));
}

}  // namespace ident
