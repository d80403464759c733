// Edges are joined at their ends first; then each chain is walked from an end that is joined to
// none, and what is left over is closed.
#include "core/io/join_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace farhorizon {

namespace {

using PlanPosition = std::array<double, 2>;

// An end of an edge, 0 at a and 1 at b.
struct EdgeEnd {
  PlanPosition point;
  std::size_t edge;
  std::size_t end;
};

PlanPosition PointOf(const PlanEdge& edge, std::size_t end) { return end == 0 ? edge.a : edge.b; }

// Joins the ends of edges at points by twos.
class Joints {
 public:
  explicit Joints(const std::vector<PlanEdge>& edges)
      : edges_(edges), joined_(2 * edges.size(), kNone) {
    std::vector<EdgeEnd> ends;
    ends.reserve(2 * edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t end = 0; end < 2; ++end) ends.push_back({PointOf(edges[i], end), i, end});
    }
    std::ranges::stable_sort(ends, {}, &EdgeEnd::point);
    for (std::size_t begin = 0; begin < ends.size();) {
      std::size_t end = begin;
      while (end < ends.size() && ends[end].point == ends[begin].point) ++end;
      JoinAt({ends.begin() + static_cast<std::ptrdiff_t>(begin),
              ends.begin() + static_cast<std::ptrdiff_t>(end)});
      begin = end;
    }
  }

  // The end that is joined to that of `edge`: 2 * edge + end; kNone: none.
  [[nodiscard]] std::size_t At(std::size_t edge, std::size_t end) const {
    return joined_[2 * edge + end];
  }

  static constexpr std::size_t kNone = SIZE_MAX;

 private:
  // The cosine of the angle between two edges as they leave a point.
  [[nodiscard]] double Cosine(const EdgeEnd& p, const EdgeEnd& q) const {
    const auto leave = [this](const EdgeEnd& e) -> PlanPosition {
      const PlanPosition far = PointOf(edges_[e.edge], 1 - e.end);
      const double x = far[0] - e.point[0];
      const double y = far[1] - e.point[1];
      const double length = std::sqrt(x * x + y * y);
      return {x / length, y / length};
    };
    const PlanPosition a = leave(p);
    const PlanPosition b = leave(q);
    return a[0] * b[0] + a[1] * b[1];
  }

  void JoinAt(std::vector<EdgeEnd> free) {
    while (free.size() > 1) {
      std::pair<std::size_t, std::size_t> best;
      double least = 2;
      for (std::size_t i = 0; i < free.size(); ++i) {
        for (std::size_t j = i + 1; j < free.size(); ++j) {
          if (edges_[free[i].edge].kind != edges_[free[j].edge].kind) continue;
          const double cosine = Cosine(free[i], free[j]);
          if (cosine >= least) continue;
          least = cosine;
          best = {i, j};
        }
      }
      if (least == 2) return;
      const EdgeEnd p = free[best.first];
      const EdgeEnd q = free[best.second];
      joined_[2 * p.edge + p.end] = 2 * q.edge + q.end;
      joined_[2 * q.edge + q.end] = 2 * p.edge + p.end;
      free.erase(free.begin() + static_cast<std::ptrdiff_t>(best.second));
      free.erase(free.begin() + static_cast<std::ptrdiff_t>(best.first));
    }
  }

  const std::vector<PlanEdge>& edges_;
  std::vector<std::size_t> joined_;
};

}  // namespace

std::vector<std::vector<ChainedEdge>> JoinEdges(const std::vector<PlanEdge>& edges) {
  const Joints joints(edges);
  std::vector<bool> taken(edges.size(), false);
  std::vector<std::vector<ChainedEdge>> chains;
  const auto walk = [&](std::size_t edge, std::size_t end) {
    std::vector<ChainedEdge>& chain = chains.emplace_back();
    for (;;) {
      taken[edge] = true;
      chain.push_back({edge, end == 1});
      const std::size_t next = joints.At(edge, 1 - end);
      if (next == Joints::kNone || taken[next / 2]) return;
      edge = next / 2;
      end = next % 2;
    }
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      if (!taken[i] && joints.At(i, end) == Joints::kNone) walk(i, end);
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!taken[i]) walk(i, 0);
  }
  return chains;
}

}  // namespace farhorizon
