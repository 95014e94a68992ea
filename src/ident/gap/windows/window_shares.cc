// Sums over blocks of flight serve every set and every part: the model is linear over them.
#include "ident/gap/windows/window_shares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDrawn = 4.0;  // s, as in shares of whole models
constexpr int kDraws = 400;
constexpr double kNoGap = 1.02;  // times the square of the floor

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

// Of some blocks: what every set misses.
std::vector<double> shares_of(const std::vector<double>& errors, double floor) {
  const double gap = errors[0] - floor;
  if (!(errors[0] > kNoGap * floor)) return {};
  std::vector<double> shares = shapley_values(errors);
  for (double& s : shares) s /= gap;
  const double closed = std::accumulate(shares.begin(), shares.end(), 0.0);
  if (closed > 1)
    for (double& s : shares) s /= closed;
  shares.push_back(std::max(1 - closed, 0.0));
  return shares;
}

std::array<double, 2> interval_of(std::vector<double> draws) {
  if (draws.size() < kDraws / 2) return {kNaN, kNaN};
  std::ranges::sort(draws);
  return {draws[draws.size() / 40], draws[draws.size() - 1 - draws.size() / 40]};
}

WindowShares shared_out(const std::vector<std::string>& names, const std::vector<std::vector<double>>& errors,
                        const std::vector<double>& windows, double floor_each) {
  const std::size_t sets = errors.front().size();
  const auto sum = [&](const std::vector<std::size_t>& blocks, double& floor) {
    std::vector<double> out(sets, 0.0);
    floor = 0;
    for (const std::size_t b : blocks) {
      for (std::size_t s = 0; s < sets; ++s) out[s] += errors[b][s];
      floor += windows[b] * floor_each;
    }
    return out;
  };
  std::vector<std::size_t> all(errors.size());
  std::iota(all.begin(), all.end(), 0U);
  double floor = 0;
  const std::vector<double> total = sum(all, floor);
  const double count = std::accumulate(windows.begin(), windows.end(), 0.0);
  WindowShares out;
  const auto rms = [&](double x) { return std::sqrt(std::max(x, 0.0) / std::max(count, 1.0)); };
  out.before = rms(total.front()), out.after = rms(total.back()), out.floor = rms(floor);
  out.shares.without_causes = out.before / std::max(out.floor, 1e-12);
  const std::vector<double> shares = shares_of(total, floor);
  std::vector<std::vector<double>> draws(names.size() + 1);
  std::mt19937_64 random(22);
  for (int d = 0; d < kDraws && !shares.empty() && errors.size() > 1; ++d) {
    std::vector<std::size_t> drawn(all.size());
    for (std::size_t& b : drawn) b = random() % all.size();
    double floor_drawn = 0;
    const std::vector<double> one = shares_of(sum(drawn, floor_drawn), floor_drawn);
    for (std::size_t c = 0; c < one.size(); ++c) draws[c].push_back(one[c]);
  }
  const auto share = [&](std::size_t c) {
    return shares.empty() ? Share{} : Share{shares[c], interval_of(draws[c])};
  };
  for (std::size_t c = 0; c < names.size(); ++c) out.shares.causes.push_back({names[c], share(c)});
  out.shares.remaining = share(names.size());
  return out;
}

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
  std::vector<std::vector<double>> errors(blocks.size(), std::vector<double>(sets));
  std::vector<SetFit> fits;
  for (unsigned set = 0; set < sets; ++set) fits.emplace_back(at, players, set);
  MatrixXd H = at.form.prior.information();
  VectorXd g = at.form.prior.gradient();
  for (const Block& b : blocks) H += b.H, g += b.g;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (unsigned set = 0; set < sets; ++set)
      errors[b][set] = blocks[b].felt.at(fits[set].step(H - blocks[b].H, g - blocks[b].g));
  std::vector<double> windows;
  for (const Block& b : blocks) windows.push_back(b.felt.windows);
  return shared_out(names, errors, windows, 3 * sensor_variance(model.motion(), model.what()));
}

}  // namespace ident
