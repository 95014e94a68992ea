// How much of a result is wanted.
#pragma once

namespace ident {

/// What of a result somebody will see. Work for more than that need not be done: JSON has the numbers, a
/// terminal shows tables too, a report pictures as well.
enum class Shown { numbers, tables, pictures };

}  // namespace ident
