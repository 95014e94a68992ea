// Does thrust follow the square of the speed? The quadratic law against one with a linear term.
#pragma once

#include "ident/bench/thrust/thrust_sweep_fit.h"

namespace ident {

/// Misfits are RMS over set-points in % of full scale.
struct LawJudgement {
  double misfit_percent_fs = kNaN;            ///< of tare + k Omega^2
  double with_linear_term_percent_fs = kNaN;  ///< of a + b Omega + c Omega^2
  double noise_percent_fs = kNaN;             ///< of one point, as the first fit sees it
  double full_scale = kNaN;
  double p_value = kNaN;   ///< that the terms added would come out as large if the quadratic law were true
  bool law_fails = false;  ///< significant, and large enough to matter
};

/// The added terms are tested together (Wald's F), with the covariance that knows the colour of the
/// residuals. `name`: thrust or torque.
LawJudgement judge_law(const SweepChannel& channel, const ChannelResiduals& quadratic,
                       const ChannelResiduals& with_linear_term, const LeastSquaresFit& linear_fit);

}  // namespace ident
