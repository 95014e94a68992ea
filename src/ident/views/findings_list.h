// The list of all findings as a result of `ident check --list`, and as the guide's page of warnings.
#pragma once

#include <string>

#include "ident/result/result.h"

namespace ident {

/// Tables by stage; in JSON the array `findings`.
Result findings_list();

/// notebooks/guide/warnings.md, which is written by this function only.
std::string findings_page();

}  // namespace ident
