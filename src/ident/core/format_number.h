// Numbers as text: rounded to their uncertainty, the same in every table, report and message.
#pragma once

#include <array>
#include <string>

namespace ident {

/// `value +- std`, both to the second significant digit of `std`: "12.30 ± 0.45", "(6.014 ± 0.012)e-6".
/// A deviation below 1e-9 of the value is shown as that. Below 1e-3 and from 1e5 on the power of ten is taken
/// out. Without a usable `std` the value alone.
std::string format_with_uncertainty(double value, double std);

/// The value of `format_with_uncertainty` alone: "12.30", "6.014e-6".
std::string format_rounded(double value, double std);

/// An interval with the digits and the power of ten of `format_rounded(value, std)`: "[11.42, 13.18]".
std::string format_interval(const std::array<double, 2>& interval, double value, double std);

/// Significant digits where no uncertainty is known, without trailing zeros: "0.25", "3.1e-7".
/// What is not finite is an en dash.
std::string format_number(double value, int digits = 4);

}  // namespace ident
