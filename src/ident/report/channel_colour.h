// Which colour a series has: the same channel has the same colour in every plot.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ident/result/result.h"

namespace ident {

constexpr int kColours = 8;  ///< --c0 .. --c7 of the style sheet

/// "p" of "p measured" and "p, predicted".
std::string channel_of(std::string_view series_name);

/// A colour for every series of a plot. Axes, rotors and known quantities have theirs; other names take the
/// first that the plot leaves free.
std::vector<int> channel_colours(const std::vector<Series>& series);

}  // namespace ident
