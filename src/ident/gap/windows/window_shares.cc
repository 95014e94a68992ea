// Sums over blocks of flight serve every set and every part: the model is linear over them.
#include "ident/gap/windows/window_shares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDrawn = 4.0;  // s, as in shares of whole models

struct Quadratic {
  MatrixXd A;
  VectorXd b;
  double c = 0, windows = 0;
  double at(const VectorXd& d) const { return c + 2 * b.dot(d) + d.dot(A * d); }
};

struct Block {
  MatrixXd H;  // weighted
  VectorXd g;
  Quadratic felt;  // in the units that a user feels
};

std::vector<Block> blocks_of(const WindowModel& model, const WindowStanding& best) {
  std::map<std::pair<std::size_t, long>, Block> blocks;
  const Index n = best.at.form.g.size();
  const std::vector<Window>& windows = model.windows();
  for (std::size_t w = 0; w < windows.size(); ++w) {
    Block& block = blocks[{windows[w].arc, std::lround(std::floor(windows[w].t / kDrawn))}];
    Quadratic& q = block.felt;
    if (block.g.size() == 0) {
      block.H = q.A = MatrixXd::Zero(n, n);
      block.g = q.b = VectorXd::Zero(n);
    }
    const Index row = 3 * static_cast<Index>(w);
    const MatrixXd J = best.misses.slopes.middleRows(row, 3);
    const VectorXd r = best.misses.missed.segment<3>(row), weight = best.misses.weight.segment<3>(row);
    block.H += J.transpose() * weight.asDiagonal() * J;
    block.g += J.transpose() * weight.cwiseProduct(r);
    q.A += J.transpose() * J, q.b += J.transpose() * r, q.c += r.squaredNorm(), q.windows += 1;
  }
  std::vector<Block> out;
  for (auto& [place, block] : blocks) out.push_back(std::move(block));
  return out;
}

// What is free with a set of the causes found; the others are held where they are absent.
class SetFit {
 public:
  SetFit(const Standing& at, const std::vector<std::vector<int>>& players, unsigned set)
      : free_(base_unknowns(at.form, at.problem)), held_(VectorXd::Zero(at.form.g.size())) {
    std::vector<bool> on(static_cast<std::size_t>(at.form.constants), false);
    for (std::size_t c = 0; c < players.size(); ++c)
      for (const int member : players[c])
        for (const int i : at.problem.candidates[static_cast<std::size_t>(member)].directions)
          if ((set >> c & 1U) != 0 && !on[static_cast<std::size_t>(i)])
            on[static_cast<std::size_t>(i)] = true, free_.push_back(i);
    for (int i = 0; i < at.form.constants; ++i)
      if (!on[static_cast<std::size_t>(i)]) held_[i] = at.form.null[i];
  }

  VectorXd step(const MatrixXd& H, const VectorXd& g) const {
    const VectorXd r = (g + H * held_)(free_);
    const MatrixXd A = H(free_, free_);
    const VectorXd d = A.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    MatrixXd scaled = d.asDiagonal() * A * d.asDiagonal();
    scaled.diagonal().array() += 1e-10;
    VectorXd out = held_;
    out(free_) = -(d.asDiagonal() * VectorXd(scaled.ldlt().solve(VectorXd(d.asDiagonal() * r))));
    return out;
  }

 private:
  std::vector<int> free_;
  VectorXd held_;
};

}  // namespace

WindowShares window_shares(const WindowModel& model, const WindowSearch& search) {
  const Standing& at = search.best.at;
  const std::vector<std::string> names = names_of(at.model.adopted);
  std::vector<std::vector<int>> players(names.size());
  for (const int c : at.have) {
    const auto own = std::ranges::find(names, at.problem.candidates[static_cast<std::size_t>(c)].name);
    // What another cause brings along goes with the first.
    players[own == names.end() ? 0 : static_cast<std::size_t>(own - names.begin())].push_back(c);
  }
  const std::vector<Block> blocks = blocks_of(model, search.best);
  const unsigned sets = 1U << players.size();
  const double floor = 3 * sensor_variance(model.motion(), model.what());  // of a window
  std::vector<BlockErrors> errors;
  for (const Block& b : blocks)
    errors.push_back({std::vector<double>(sets), b.felt.windows * floor, b.felt.windows});
  std::vector<SetFit> fits;
  for (unsigned set = 0; set < sets; ++set) fits.emplace_back(at, players, set);
  MatrixXd H = at.form.prior.information();
  VectorXd g = at.form.prior.gradient();
  for (const Block& b : blocks) H += b.H, g += b.g;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (unsigned set = 0; set < sets; ++set)
      errors[b].errors[set] = blocks[b].felt.at(fits[set].step(H - blocks[b].H, g - blocks[b].g));
  WindowShares out{.shares = share_out(names, errors), .floor = std::sqrt(floor)};
  double before = 0, after = 0, windows = 0;
  for (const BlockErrors& b : errors)
    before += b.errors.front(), after += b.errors.back(), windows += b.windows;
  out.before = std::sqrt(std::max(before, 0.0) / std::max(windows, 1.0));
  out.after = std::sqrt(std::max(after, 0.0) / std::max(windows, 1.0));
  out.shares.without_causes = out.before / std::max(out.floor, 1e-12);
  return out;
}

}  // namespace ident
