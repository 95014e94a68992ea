// Constants of the chosen rung in place of those of a refinement that predicts worse.
#pragma once

#include "ident/flight/ladder/ladder.h"
#include "ident/result/result.h"

namespace ident {

/// Whether a constant that nobody stated is in a rung for whatever makes a lasting moment: a rotor of less
/// thrust, a bent arm and a shifted centre of gravity make the same one.
bool stands_for_lasting_moment(const RungConstant& constant);

/// A constant of a rung as a result has it.
Parameter parameter_of(const RungConstant& constant);

/// Adds the ladder to a result. Where another rung than the full one is chosen, its constants take the place
/// of the refined ones; what it has not estimated is as stated, with a note why.
void settle_for_chosen(Result& result, const LadderResult& ladder, const Vehicle& vehicle);

}  // namespace ident
