// Writes ident.yaml.
#pragma once

#include <string>

#include "ident/io/campaign/campaign.h"

namespace ident {

/// The text of `ident.yaml` in that folder; files are named as seen from there.
std::string campaign_text(const Campaign& campaign, const std::string& folder);

/// A file as seen from that folder; links are not followed.
std::string seen_from(const std::string& folder, const std::string& path);

}  // namespace ident
