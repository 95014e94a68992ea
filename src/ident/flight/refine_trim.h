// Refinement and verification of logs of which only the balance of the rotors is left.
#pragma once

#include <string>
#include <vector>

#include "ident/flight/trim/trim.h"
#include "ident/result/result.h"

namespace ident {

/// `ident flightlog --refine` of such logs: what each rotor thrusts relative to the others, and thrust for a
/// command on the whole. Everything else keeps what was stated of it, and is named.
void refine_trim(Result& result, const FlightRecord& record, const std::vector<double>& p,
                 const std::vector<std::string>& free);

/// What the missing signals cost, as a warning.
Warning without_turning();

/// `ident flightlog` of such logs: the balance with constants as stated.
void verify_trim(Result& result, const FlightRecord& record, const std::vector<double>& p);

/// The unbalance y that is left in each log.
Section trim_section(const FlightRecord& record, const Trim& trim, const Eigen::VectorXd& y);
std::string scatter_in_words(const Trim& trim, const TrimScatter& scatter);

}  // namespace ident
