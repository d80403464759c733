// A line sweeps over the plane from west to east and triangulates behind itself
// [HertelMehlhorn83]. Between two neighbouring edges that it crosses is a gap. Of a gap that is
// enclosed, a chain of points from the lower edge's west end to the upper edge's bounds what has
// been triangulated so far:
//
//      u---------- upper edge ------|          chain l, p, r, u; r is its newest point, and its
//       \                           |          easternmost, because points come from west to east
//        `----r                     |          q: joined with r, where it lies between the edges,
//            /                      q          which splits the gap; with the points that it sees
//      p----'                       |          from l or u on, where it lies on that edge
//       \                           |
//        l------- lower edge -------|
//
// The chain turns away from the line at each point between its ends except the newest, or a
// triangle would have been cut off there. Points on one meridian are met from south to north, as
// if the plane were sheared by less than anything.
#include "core/pipeline/terrain_tiles/fill_plan.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

#include "core/exact/int128.h"

namespace farhorizon {

namespace {

constexpr std::uint32_t kNoIndex = UINT32_MAX;

Error Entangled() {
  return {ErrorCode::kUnsupportedData,
          "the sides of a level cross or do not close in longitude and latitude; leave "
          "quantized-mesh out of --formats",
          "bad-mesh"};
}

class Sweep {
 public:
  using Corners = std::array<std::uint32_t, 3>;

  Sweep(const std::vector<LatticePoint>& points,
        const std::vector<std::array<std::uint32_t, 2>>& edges)
      : points_(&points), active_(Below{this}) {
    starting_.resize(points.size());
    ending_.resize(points.size());
    for (const auto& [a, b] : edges) {
      const bool eastwards = points[a] < points[b];
      const auto i = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back({eastwards ? a : b, eastwards ? b : a, kNoIndex, false, {}});
      starting_[edges_[i].west].push_back(i);
      ending_[edges_[i].east].push_back(i);
    }
  }

  Result<std::vector<Corners>> Run() {
    std::vector<std::uint32_t> order(points_->size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [this](std::uint32_t a, std::uint32_t b) { return (*points_)[a] < (*points_)[b]; });
    for (const std::uint32_t v : order) {
      if (starting_[v].empty() && ending_[v].empty()) continue;
      if (!Meet(v)) return Entangled();
    }
    return std::move(triangles_);
  }

 private:
  // Orders the edges that the line crosses from the south to the north.
  struct Below {
    using is_transparent = void;
    const Sweep* sweep;
    bool operator()(std::uint32_t e, std::uint32_t f) const { return sweep->IsBelow(e, f); }
    bool operator()(std::uint32_t e, const LatticePoint& p) const {
      return sweep->SideOf(e, p) > 0;
    }
    bool operator()(const LatticePoint& p, std::uint32_t e) const {
      return sweep->SideOf(e, p) < 0;
    }
  };
  using Active = std::set<std::uint32_t, Below>;
  // An edge, and the gap above it as long as the line crosses it. chain: kNoIndex in a gap that is
  // not enclosed.
  struct SweptEdge {
    std::uint32_t west;
    std::uint32_t east;
    std::uint32_t chain;
    bool enclosed;
    Active::iterator place;
  };
  struct Link {
    std::uint32_t point;
    std::uint32_t lower;
    std::uint32_t upper;
  };
  struct Chain {
    std::uint32_t lowest;
    std::uint32_t uppermost;
    std::uint32_t newest;
  };

  [[nodiscard]] int SideOf(std::uint32_t e, const LatticePoint& p) const {
    return Orientation((*points_)[edges_[e].west], (*points_)[edges_[e].east], p);
  }

  [[nodiscard]] bool IsBelow(std::uint32_t e, std::uint32_t f) const {
    const auto& points = *points_;
    if (e == f) return false;
    if (points[edges_[e].west] <= points[edges_[f].west]) {
      const int side = SideOf(e, points[edges_[f].west]);
      return side != 0 ? side > 0 : SideOf(e, points[edges_[f].east]) > 0;
    }
    const int side = SideOf(f, points[edges_[e].west]);
    return side != 0 ? side < 0 : SideOf(f, points[edges_[e].east]) < 0;
  }

  std::uint32_t NewLink(std::uint32_t point) {
    links_.push_back({point, kNoIndex, kNoIndex});
    return static_cast<std::uint32_t>(links_.size() - 1);
  }

  std::uint32_t NewChain(std::uint32_t point) {
    const std::uint32_t link = NewLink(point);
    chains_.push_back({link, link, link});
    return static_cast<std::uint32_t>(chains_.size() - 1);
  }

  // Joins `point` to the upper end of the chain, and cuts off the triangles that it sees there.
  void AddUppermost(std::uint32_t chain, std::uint32_t point) {
    std::uint32_t at = chains_[chain].uppermost;
    while (links_[at].lower != kNoIndex) {
      const std::uint32_t next = links_[at].lower;
      if (Orientation((*points_)[links_[next].point], (*points_)[point],
                      (*points_)[links_[at].point]) <= 0) {
        break;
      }
      triangles_.push_back({links_[next].point, point, links_[at].point});
      at = next;
    }
    const std::uint32_t link = NewLink(point);
    links_[link].lower = at;
    links_[at].upper = link;
    chains_[chain].uppermost = chains_[chain].newest = link;
  }

  void AddLowest(std::uint32_t chain, std::uint32_t point) {
    std::uint32_t at = chains_[chain].lowest;
    while (links_[at].upper != kNoIndex) {
      const std::uint32_t next = links_[at].upper;
      if (Orientation((*points_)[links_[at].point], (*points_)[point],
                      (*points_)[links_[next].point]) <= 0) {
        break;
      }
      triangles_.push_back({links_[at].point, point, links_[next].point});
      at = next;
    }
    const std::uint32_t link = NewLink(point);
    links_[link].upper = at;
    links_[at].lower = link;
    chains_[chain].lowest = chains_[chain].newest = link;
  }

  // Splits the chain at its newest point, which `point` sees; the upper part is a chain of its own.
  std::uint32_t Split(std::uint32_t chain, std::uint32_t point) {
    const std::uint32_t newest = chains_[chain].newest;
    const std::uint32_t twin = NewLink(links_[newest].point);
    const std::uint32_t upper = links_[newest].upper;
    links_[twin].upper = upper;
    if (upper != kNoIndex) links_[upper].lower = twin;
    chains_.push_back({twin, upper == kNoIndex ? twin : chains_[chain].uppermost, twin});
    links_[newest].upper = kNoIndex;
    chains_[chain].uppermost = newest;
    const auto above = static_cast<std::uint32_t>(chains_.size() - 1);
    AddUppermost(chain, point);
    AddLowest(above, point);
    return above;
  }

  // Joins two chains, both of which end at the point that was added last.
  void Merge(std::uint32_t lower, std::uint32_t upper) {
    const std::uint32_t kept = chains_[lower].uppermost;
    const std::uint32_t gone = chains_[upper].lowest;
    links_[kept].upper = links_[gone].upper;
    if (links_[gone].upper == kNoIndex) return;
    links_[links_[gone].upper].lower = kept;
    chains_[lower].uppermost = chains_[upper].uppermost;
    chains_[lower].newest = kept;
  }

  // The gap between the edges above and below a point. above: the first edge above it.
  struct Gap {
    Active::iterator above;
    bool enclosed = false;
    std::uint32_t chain = kNoIndex;
  };

  // Ends the edges that end at v, and closes the gaps between them. Result: the gap above them;
  // nullopt where they do not lie beside one another, or a gap is not closed.
  std::optional<Gap> End(std::uint32_t v) {
    Gap gap;
    Active::iterator lowest = edges_[ending_[v].front()].place;
    while (lowest != active_.begin() && edges_[*std::prev(lowest)].east == v) --lowest;
    for (std::size_t i = 0; i < ending_[v].size(); ++i) {
      if (lowest == active_.end() || edges_[*lowest].east != v) return std::nullopt;
      gap.enclosed = edges_[*lowest].enclosed;
      gap.chain = edges_[*lowest].chain;
      lowest = active_.erase(lowest);
      if (i + 1 == ending_[v].size() || !gap.enclosed) continue;
      AddUppermost(gap.chain, v);
      // Of a gap that closes v sees the whole chain.
      const Chain& closed = chains_[gap.chain];
      if (links_[closed.uppermost].lower != closed.lowest) return std::nullopt;
    }
    gap.above = lowest;
    return gap;
  }

  // The line gets to v. False where the edges are entangled.
  bool Meet(std::uint32_t v) {
    const bool ends = !ending_[v].empty();
    std::optional<Gap> above = ends ? End(v) : Gap{active_.upper_bound((*points_)[v])};
    if (!above) return false;
    bool enclosed_below = false;
    std::uint32_t chain_below = kNoIndex;
    if (above->above != active_.begin()) {
      const std::uint32_t below = *std::prev(above->above);
      if (SideOf(below, (*points_)[v]) == 0) return false;
      enclosed_below = edges_[below].enclosed;
      chain_below = edges_[below].chain;
    }
    if (ends) {
      if (enclosed_below) AddUppermost(chain_below, v);
      if (above->enclosed) AddLowest(above->chain, v);
    } else {
      above->enclosed = enclosed_below;
      if (enclosed_below) above->chain = Split(chain_below, v);
    }
    const bool odd = starting_[v].size() % 2 != 0;
    if ((enclosed_below != above->enclosed) != odd) return false;
    if (!starting_[v].empty()) return Start(v, enclosed_below, above->chain);
    if (enclosed_below) Merge(chain_below, above->chain);
    return true;
  }

  // Starts the edges that start at v. chain_above: of the gap above them, where it is enclosed.
  bool Start(std::uint32_t v, bool enclosed, std::uint32_t chain_above) {
    std::vector<std::uint32_t>& starting = starting_[v];
    std::sort(starting.begin(), starting.end(),
              [this](std::uint32_t e, std::uint32_t f) { return IsBelow(e, f); });
    for (std::size_t i = 0; i < starting.size(); ++i) {
      SweptEdge& edge = edges_[starting[i]];
      const auto [place, is_new] = active_.insert(starting[i]);
      if (!is_new) return false;
      edge.place = place;
      enclosed = !enclosed;
      edge.enclosed = enclosed;
      edge.chain = kNoIndex;
      if (enclosed) edge.chain = i + 1 == starting.size() ? chain_above : NewChain(v);
    }
    return true;
  }

  const std::vector<LatticePoint>* points_;
  std::vector<SweptEdge> edges_;
  std::vector<std::vector<std::uint32_t>> starting_;
  std::vector<std::vector<std::uint32_t>> ending_;
  Active active_;
  std::vector<Link> links_;
  std::vector<Chain> chains_;
  std::vector<Corners> triangles_;
};

}  // namespace

int Orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return SignOf(Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x));
}

Result<std::vector<std::array<std::uint32_t, 3>>> TriangulateInside(
    const std::vector<LatticePoint>& points,
    const std::vector<std::array<std::uint32_t, 2>>& edges) {
  return Sweep(points, edges).Run();
}

}  // namespace farhorizon
