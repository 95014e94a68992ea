// What was laid out as a campaign, for the terminal and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "ident/io/campaign/lay_out.h"

namespace ident {

/// What each file was taken for, what was left alone and why, and what to do next.
std::string layout_text(const LaidOutCampaign& layout, const std::string& folder);

/// `campaign`, `vehicle`, `taken`, `left` and `next`; files as seen from the folder.
nlohmann::ordered_json layout_json(const LaidOutCampaign& layout, const std::string& folder);

}  // namespace ident
