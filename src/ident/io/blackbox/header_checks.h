// Says why the frames of a blackbox header cannot be decoded, before any is tried.
#pragma once

#include <string>

#include "ident/io/blackbox/header.h"

namespace ident::blackbox {

/// Why frames of this header cannot be decoded; empty where they can.
std::string reason_against(const Header& header);

}  // namespace ident::blackbox
