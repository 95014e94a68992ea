// Differences of what was gained from the first row of a window to its last.
#include "ident/flight/ladder/window_residuals.h"

namespace ident {
namespace {

constexpr double kForceHorizon = 0.5, kForceSpacing = 0.1;     // s: users judge by half a second
constexpr double kMomentHorizon = 0.1, kMomentSpacing = 0.05;  // s: rates are turned back sooner

}  // namespace

double horizon_of(FitTo what) { return what == FitTo::forces ? kForceHorizon : kMomentHorizon; }

std::vector<Window> windows_of(const MeasuredMotion& motion, FitTo what) {
  return windows_of(motion, horizon_of(what), what == FitTo::forces ? kForceSpacing : kMomentSpacing);
}

Eigen::VectorXd missed_in(const MeasuredMotion& motion, const std::vector<Window>& windows, FitTo what,
                          const std::vector<ModelAlong>& model) {
  Eigen::VectorXd out(3 * static_cast<Eigen::Index>(windows.size()));
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const auto& [a, begin, end, t, speed] = windows[w];
    const MeasuredArc& measured = motion.arcs[a];
    const Vec3<double> miss = what == FitTo::forces
                                  ? Vec3<double>(measured.gained_W[end] - measured.gained_W[begin] -
                                                 (model[a].gained_W[end] - model[a].gained_W[begin]))
                                  : Vec3<double>(measured.body[end].w_B - measured.body[begin].w_B -
                                                 (model[a].turned_B[end] - model[a].turned_B[begin]));
    out.segment<3>(3 * static_cast<Eigen::Index>(w)) = miss;
  }
  return out;
}

}  // namespace ident
