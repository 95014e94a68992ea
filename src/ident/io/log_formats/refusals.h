// Files that people take for a log, and what to do with each of them.
#pragma once

#include <string>
#include <string_view>

namespace ident {

/// Throws InputError where the first bytes are those of a compressed file, a Git LFS pointer or a telemetry
/// log.
void refuse_no_log(std::string_view first, const std::string& file);

}  // namespace ident
