// Thins lines, dots and bands to the resolution of the paper.
#include "ident/report/decimate.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace ident {
namespace {

constexpr std::size_t kFewPoints = 1500;  // drawn as they are
constexpr std::size_t kManyDots = 5000;   // from here on one dot per 1.5 pixels

bool drawable(PaperPoint p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::string pair_of(PaperPoint p) { return coordinate(p.x) + " " + coordinate(p.y); }

/// Ends of the stretches of drawable points, [from, to).
template <typename Drawable>
std::vector<std::pair<std::size_t, std::size_t>> stretches(std::size_t count, Drawable is_drawable) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_drawable(i)) continue;
    if (out.empty() || out.back().second != i) out.emplace_back(i, i);
    out.back().second = i + 1;
  }
  return out;
}

/// First, lowest, highest and last of the points [from, to) in their order.
void keep_column(const std::vector<PaperPoint>& points, std::size_t from, std::size_t to,
                 std::vector<PaperPoint>& kept) {
  std::size_t low = from, high = from;
  for (std::size_t i = from; i < to; ++i) {
    if (points[i].y < points[low].y) low = i;
    if (points[i].y > points[high].y) high = i;
  }
  std::size_t last = to;
  for (const std::size_t i : {from, std::min(low, high), std::max(low, high), to - 1})
    if (i != last) kept.push_back(points[last = i]);
}

std::vector<PaperPoint> thinned(const std::vector<PaperPoint>& points, std::size_t from, std::size_t to) {
  std::vector<PaperPoint> kept;
  for (std::size_t i = from; i < to;) {
    std::size_t end = i + 1;
    while (end < to && std::floor(points[end].x) == std::floor(points[i].x)) ++end;
    keep_column(points, i, end, kept);
    i = end;
  }
  return kept;
}

std::string polyline(const std::vector<PaperPoint>& points, std::size_t from, std::size_t to,
                     const char* start) {
  std::string out;
  for (std::size_t i = from; i < to; ++i) out += (i == from ? start : "L") + pair_of(points[i]);
  return out;
}

}  // namespace

std::string line_path(const std::vector<PaperPoint>& points) {
  std::string out;
  for (const auto& [from, to] :
       stretches(points.size(), [&](std::size_t i) { return drawable(points[i]); })) {
    if (to - from == 1) {
      out += "M" + pair_of(points[from]) + "h0";
    } else if (points.size() <= kFewPoints) {
      out += polyline(points, from, to, "M");
    } else {
      const std::vector<PaperPoint> kept = thinned(points, from, to);
      out += polyline(kept, 0, kept.size(), "M");
    }
  }
  return out;
}

std::string dots_path(const std::vector<PaperPoint>& points) {
  const double cell = points.size() > kManyDots ? 1.5 : 0.5;
  std::unordered_set<long> seen;
  std::string out;
  for (const PaperPoint p : points) {
    if (!drawable(p)) continue;
    const long key = std::lround(p.x / cell) * 100000 + std::lround(p.y / cell);
    if (seen.insert(key).second) out += "M" + pair_of(p) + "h0";
  }
  return out;
}

std::string band_path(const std::vector<PaperPoint>& low, const std::vector<PaperPoint>& high) {
  const auto both = [&](std::size_t i) { return drawable(low[i]) && drawable(high[i]); };
  const std::size_t stride = std::max<std::size_t>(1, low.size() / kFewPoints);
  std::string out;
  for (const auto& [from, to] : stretches(std::min(low.size(), high.size()), both)) {
    std::vector<PaperPoint> edge;
    for (std::size_t i = from; i < to; i += stride) edge.push_back(low[i]);
    edge.push_back(low[to - 1]);
    edge.push_back(high[to - 1]);
    for (std::size_t i = to; i > from; i -= std::min(stride, i - from)) edge.push_back(high[i - 1]);
    edge.push_back(high[from]);
    out += polyline(edge, 0, edge.size(), "M") + "Z";
  }
  return out;
}

}  // namespace ident
