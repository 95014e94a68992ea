// Predictions with every subset of the causes found, and a bootstrap over blocks of flight.
#include "ident/gap/evidence/shares.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "ident/core/stage_times.h"
#include "ident/gap/hypotheses/cause_alone.h"

namespace ident {
namespace {

constexpr double kBlock = 4.0;           // s of flight that are drawn together: gusts last less
constexpr int kDraws = 400;              // of the bootstrap
constexpr std::size_t kMostPlayers = 5;  // causes shared out one by one; the weakest beyond are one
constexpr double kNoGap = 1.02;          // times the square of the floor: below it there is nothing to share

// A name with its causes, one for each rotor.
struct Player {
  std::string name;
  std::vector<Candidate> causes;
};

std::vector<Player> players_of(const SearchResult& search) {
  std::vector<Player> out;
  for (const std::string& name : names_of(search.best.adopted)) {
    out.push_back({name, {}});
    for (const Candidate& c : search.best.adopted)
      if (c.name == name) out.back().causes.push_back(c);
  }
  return out;
}

void add(BlockErrors& sums, const BlockErrors& block) {
  for (std::size_t s = 0; s < sums.errors.size(); ++s) sums.errors[s] += block.errors[s];
  sums.floor += block.floor, sums.windows += block.windows;
}

std::vector<double> shares_of(const BlockErrors& sums) {
  const double gap = sums.errors[0] - sums.floor;
  if (!(sums.errors[0] > kNoGap * sums.floor)) return {};
  std::vector<double> shares = shapley_values(sums.errors);
  for (double& s : shares) s /= gap;
  const double closed = std::accumulate(shares.begin(), shares.end(), 0.0);
  if (closed > 1)  // by chance below the floor: nothing is left
    for (double& s : shares) s /= closed;
  shares.push_back(std::max(1 - closed, 0.0));
  return shares;
}

std::array<double, 2> interval_of(std::vector<double> draws) {
  if (draws.size() < kDraws / 2) return {kNaN, kNaN};
  std::ranges::sort(draws);
  return {draws[draws.size() / 40], draws[draws.size() - 1 - draws.size() / 40]};
}

}  // namespace

double closed_by_constants(const GapShares& shares, const GapClosed& gap) {
  const double floor = gap.floor * gap.floor, before = gap.before * gap.before,
               rest = shares.without_causes * shares.without_causes;
  if (!(before > kNoGap * floor) || !std::isfinite(rest)) return 0;
  return 1 - std::max(rest - floor, 0.0) / (before - floor);
}

std::vector<double> shapley_values(const std::vector<double>& errors) {
  const auto sets = static_cast<unsigned>(errors.size());
  const auto players = static_cast<std::size_t>(std::bit_width(sets) - 1);
  std::vector<double> weight(players);  // of a set of that size without the player: s! (k-1-s)! / k!
  for (std::size_t s = 0; s < players; ++s)
    weight[s] = std::tgamma(static_cast<double>(s + 1)) * std::tgamma(static_cast<double>(players - s)) /
                std::tgamma(static_cast<double>(players + 1));
  std::vector<double> out(players, 0.0);
  for (std::size_t c = 0; c < players; ++c)
    for (unsigned set = 0; set < sets; ++set)
      if ((set >> c & 1U) == 0)
        out[c] +=
            weight[static_cast<std::size_t>(std::popcount(set))] * (errors[set] - errors[set | 1U << c]);
  return out;
}

GapShares share_out(const std::vector<std::string>& names, const std::vector<BlockErrors>& blocks) {
  GapShares out;
  const std::size_t sets = std::size_t{1} << names.size();
  BlockErrors sums{std::vector<double>(sets), 0, 0};
  for (const BlockErrors& block : blocks) add(sums, block);
  if (!(sums.windows > 0)) return out;
  out.without_causes = std::sqrt(sums.errors[0] / sums.windows);
  const std::vector<double> shares = shares_of(sums);
  std::vector<std::vector<double>> draws(names.size() + 1);
  std::mt19937_64 random(22);
  // One block has no other to differ from: its shares have no interval.
  const int draws_of = shares.empty() || blocks.size() < 2 ? 0 : kDraws;
  for (int d = 0; d < draws_of; ++d) {
    BlockErrors drawn{std::vector<double>(sets), 0, 0};
    for (std::size_t b = 0; b < blocks.size(); ++b) add(drawn, blocks[random() % blocks.size()]);
    const std::vector<double> one = shares_of(drawn);
    for (std::size_t c = 0; c < one.size(); ++c) draws[c].push_back(one[c]);
  }
  const auto share = [&](std::size_t c) {
    return shares.empty() ? Share{} : Share{shares[c], interval_of(draws[c])};
  };
  for (std::size_t c = 0; c < names.size(); ++c) out.causes.push_back({names[c], share(c)});
  out.remaining = share(names.size());
  return out;
}

GapShares gap_shares(const HeldOutGap& all, const SearchResult& search) {
  const Stage stage("shares");
  const GapClosed& judged = all.judged;
  std::vector<Player> players = players_of(search);
  if (players.empty())
    return {judged.after, {}, {1 - judged.closed, {1 - judged.ci95[1], 1 - judged.ci95[0]}}};
  while (players.size() > kMostPlayers) {
    Player& last = players[kMostPlayers - 1];
    last.name += " and " + players.back().name;
    std::ranges::copy(players.back().causes, std::back_inserter(last.causes));
    players.pop_back();
  }
  PredictionOptions windows = without_floors(all.windows);
  const std::size_t at = all.judged_at;
  const std::vector<PredictionWindow>& after = all.after[at];
  windows.horizons = {all.windows.horizons[at]};
  const unsigned sets = 1U << players.size();
  std::map<std::pair<int, int>, BlockErrors> blocks;
  const auto enter = [&](unsigned set, const std::vector<PredictionWindow>& predicted, bool first) {
    for (const PredictionWindow& w : predicted) {
      BlockErrors& block = blocks[{w.log, static_cast<int>(w.t / kBlock)}];
      block.errors.resize(sets);
      block.errors[set] += w.error2();
      if (first) block.floor += w.floor2(), block.windows += 1;
    }
  };
  enter(sets - 1, after, true);
  for (unsigned set = 0; set + 1 < sets; ++set) {
    std::vector<Candidate> with;
    for (std::size_t c = 0; c < players.size(); ++c)
      if (set >> c & 1U) std::ranges::copy(players[c].causes, std::back_inserter(with));
    enter(set,
          predict_windows(all.record, *search.best.theta, with_only(search.best, all.found, with),
                          search.form.noise, windows)[0],
          false);
  }
  std::vector<std::string> names;
  for (const Player& player : players) names.push_back(player.name);
  std::vector<BlockErrors> listed;
  for (auto& [place, block] : blocks) listed.push_back(std::move(block));
  return share_out(names, listed);
}

}  // namespace ident
