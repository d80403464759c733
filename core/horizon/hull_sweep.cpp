// The descending plane with merged hulls. Connected ground at or above the plane hides every line that
// meets its convex hull, and hulls that touch hide what their common hull does; so the ground is known
// by a few disjoint convex polygons, which only grow and merge. A post is covered from the level on at
// which one of them takes it in. [Archambault03, chapter 3] with contours replaced by merged hulls.
#include "core/horizon/hull_sweep.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/horizon/convex_polygon.h"
#include "core/horizon/screens.h"

namespace farhorizon {
namespace {

class Sweeper {
 public:
  Sweeper(const Terrain& terrain, HullSweep& result)
      : terrain_(terrain), columns_(terrain.dem().columns), result_(result) {
    const auto posts = static_cast<std::size_t>(terrain.post_count());
    result.hulls.covered_level.assign(posts, kNoHeight);
    result.hulls.cluster.assign(posts, -1);
    next_uncovered_.resize(static_cast<std::size_t>(columns_ + 1) *
                           static_cast<std::size_t>(terrain.dem().rows));
    for (std::size_t i = 0; i < next_uncovered_.size(); ++i) {
      next_uncovered_[i] = static_cast<std::int32_t>(i % static_cast<std::size_t>(columns_ + 1));
    }
  }

  void Insert(VertexId v) {
    level_ = Height(v);
    std::vector<std::int32_t>& met = met_;
    met.clear();
    bool minimum = true;
    for (const VertexId n : terrain_.NeighboursOf(v)) {
      if (!InsertedBefore(n, v)) {
        minimum = false;
        continue;
      }
      met.push_back(Find(result_.hulls.cluster[static_cast<std::size_t>(n)]));
    }
    std::sort(met.begin(), met.end());
    met.erase(std::unique(met.begin(), met.end()), met.end());
    HorizonStatistics& statistics = result_.statistics;
    ++(met.empty()      ? statistics.peaks
       : met.size() > 1 ? statistics.saddles
       : minimum        ? statistics.minima
                        : statistics.regular);
    const std::int32_t around = result_.hulls.cluster[static_cast<std::size_t>(v)];
    if (around >= 0 && std::find(met.begin(), met.end(), Find(around)) == met.end()) {
      met.push_back(Find(around));
    }
    if (met.empty()) {
      Bear(v);
      return;
    }
    // Touching hulls are one already, so neighbours can only be in different ones across this post.
    std::int32_t cluster = met.front();
    for (std::size_t i = 1; i < met.size(); ++i) cluster = Merge(cluster, met[i]);
    if (around < 0) Enlarge(cluster, PointOf(v));
  }

  [[nodiscard]] bool IsLevel(VertexId v, VertexId n) const { return Height(v) == Height(n); }

  // Adds, for the edge from v down to w, what the hulls look like from w: a screen for each, between the
  // corners of its silhouette, as long as it shows beside those that look wider.
  void AppendScreens(VertexId v, VertexId w) {
    silhouettes_.clear();
    const Point2i eye = PointOf(w);
    for (const std::int32_t node : apart_) {
      const ConvexPolygon& polygon = polygons_[static_cast<std::size_t>(node)];
      if (polygon.corners().size() > 1 && !polygon.Contains(eye)) {
        silhouettes_.push_back(polygon.SilhouetteFrom(eye));
      }
    }
    SelectScreens(eye, Height(v), silhouettes_, result_.screens);
  }

 private:
  [[nodiscard]] std::int32_t Height(VertexId v) const {
    return terrain_.dem().heights[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] Point2i PointOf(VertexId v) const { return {v % columns_, v / columns_}; }
  [[nodiscard]] bool InsertedBefore(VertexId n, VertexId v) const {
    return Height(n) != Height(v) ? Height(n) > Height(v) : n < v;
  }

  std::int32_t Find(std::int32_t node) {
    while (roots_[static_cast<std::size_t>(node)] != node) {
      std::int32_t& root = roots_[static_cast<std::size_t>(node)];
      root = roots_[static_cast<std::size_t>(root)];
      node = root;
    }
    return node;
  }

  void Bear(VertexId v) {
    const auto node = static_cast<std::int32_t>(polygons_.size());
    polygons_.emplace_back(PointOf(v));
    roots_.push_back(node);
    result_.hulls.parent.push_back(-1);
    result_.hulls.merge_level.push_back(kNoHeight);
    apart_.push_back(node);
    ++result_.statistics.births;
    result_.statistics.clusters_max =
        std::max(result_.statistics.clusters_max, static_cast<std::int64_t>(apart_.size()));
    Cover(polygons_.back(), node);
  }

  // Joins two clusters under the one with more corners and returns it.
  std::int32_t Merge(std::int32_t a, std::int32_t b) {
    a = Find(a);
    b = Find(b);
    if (a == b) return a;
    ConvexPolygon* kept = &polygons_[static_cast<std::size_t>(a)];
    ConvexPolygon* lost = &polygons_[static_cast<std::size_t>(b)];
    if (kept->corners().size() < lost->corners().size()) {
      std::swap(a, b);
      std::swap(kept, lost);
    }
    std::vector<Point2i> corners = kept->corners();
    corners.insert(corners.end(), lost->corners().begin(), lost->corners().end());
    *kept = ConvexPolygon::HullOf(corners);
    *lost = ConvexPolygon();
    roots_[static_cast<std::size_t>(b)] = a;
    result_.hulls.parent[static_cast<std::size_t>(b)] = a;
    result_.hulls.merge_level[static_cast<std::size_t>(b)] = level_;
    apart_.erase(std::find(apart_.begin(), apart_.end(), b));
    ++result_.statistics.merges;
    Cover(*kept, a);
    return MergeWithWhatMeets(a, *kept);
  }

  void Enlarge(std::int32_t cluster, Point2i p) {
    ConvexPolygon& polygon = polygons_[static_cast<std::size_t>(cluster)];
    if (polygon.Contains(p)) return;
    ++result_.statistics.hull_changes;
    std::vector<Point2i> corners = polygon.corners();
    corners.push_back(p);
    polygon = ConvexPolygon::HullOf(corners);
    // What is new lies in the triangle of the new corner and its neighbours.
    const std::vector<Point2i>& ring = polygon.corners();
    const auto at = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), p) - ring.begin());
    std::vector<Point2i> added = {ring[(at + ring.size() - 1) % ring.size()], p,
                                  ring[(at + 1) % ring.size()]};
    const ConvexPolygon growth = ConvexPolygon::HullOf(added);
    Cover(growth, cluster);
    MergeWithWhatMeets(cluster, growth);
  }

  // The cluster after it has taken in all others that meet `growth`, the part of it that is new.
  std::int32_t MergeWithWhatMeets(std::int32_t cluster, const ConvexPolygon& growth) {
    const auto other = std::find_if(apart_.begin(), apart_.end(), [&](std::int32_t node) {
      return node != cluster && polygons_[static_cast<std::size_t>(node)].Meets(growth);
    });
    return other == apart_.end() ? cluster : Merge(cluster, *other);
  }

  // Marks the posts in `polygon` that no cluster covers yet.
  void Cover(const ConvexPolygon& polygon, std::int32_t node) {
    polygon.ForEachRow([&](std::int32_t row, std::int32_t first, std::int32_t last) {
      std::int32_t* next = next_uncovered_.data() +
                           static_cast<std::ptrdiff_t>(row) * (std::ptrdiff_t{columns_} + 1);
      const auto find = [next](std::int32_t column) {
        while (next[column] != column) {
          next[column] = next[next[column]];
          column = next[column];
        }
        return column;
      };
      for (std::int32_t column = find(first); column <= last; column = find(column)) {
        const auto post = static_cast<std::size_t>(row * columns_ + column);
        result_.hulls.covered_level[post] = level_;
        result_.hulls.cluster[post] = node;
        next[column] = column + 1;
      }
    });
  }

  const Terrain& terrain_;
  std::int32_t columns_;
  HullSweep& result_;
  std::int32_t level_ = 0;
  std::vector<ConvexPolygon> polygons_;       // by node; empty where merged away
  std::vector<std::int32_t> roots_;           // union-find over nodes
  std::vector<std::int32_t> apart_;           // nodes that are roots
  std::vector<std::int32_t> next_uncovered_;  // per row, columns + 1: union-find to the right
  std::vector<std::int32_t> met_;
  std::vector<ConvexPolygon::Silhouette> silhouettes_;
};

std::vector<VertexId> FromSummitDown(const Terrain& terrain) {
  std::vector<VertexId> order;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (terrain.IsVertex(v)) order.push_back(v);
  }
  const std::vector<std::int32_t>& heights = terrain.dem().heights;
  std::sort(order.begin(), order.end(), [&heights](VertexId a, VertexId b) {
    const std::int32_t height_a = heights[static_cast<std::size_t>(a)];
    const std::int32_t height_b = heights[static_cast<std::size_t>(b)];
    return height_a != height_b ? height_a > height_b : a < b;
  });
  return order;
}

// Whether the edge is a ridge or a border of the terrain.
bool IsRidge(const Terrain& terrain, Edge edge) {
  const Terrain::Faces faces = terrain.FacesOf(edge);
  return !faces.left || !faces.right ||
         Convexity(terrain.Point(edge.a), terrain.Point(edge.b), terrain.Point(*faces.left),
                   terrain.Point(*faces.right)) > 0;
}

// Whether the edge is inside the hull of the ground at or above it. Level edges ask for the hull of
// strictly higher ground: ground of their own height does not hide them.
bool InsideHull(const Terrain& terrain, const HullForest& hulls, Edge edge) {
  const std::int32_t a = terrain.Point(edge.a).z;
  const std::int32_t b = terrain.Point(edge.b).z;
  return hulls.Hides(edge.a, edge.b, a == b ? a + 1 : std::max(a, b));
}

}  // namespace

Result<HullSweep> SweepHulls(const Terrain& terrain, const Watch& watch) {
  HullSweep sweep;
  const std::vector<VertexId> order = FromSummitDown(terrain);
  Sweeper sweeper(terrain, sweep);
  constexpr std::size_t kBatch = 1 << 14;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i % kBatch == 0) {
      if (watch.StopRequested()) return Error{ErrorCode::kCancelled, "stopped during the sweep"};
      watch.Report("sweep", static_cast<double>(i) / static_cast<double>(order.size()));
    }
    const VertexId v = order[i];
    sweeper.Insert(v);
    for (const VertexId n : terrain.NeighboursOf(v)) {
      const bool from_here = terrain.dem().heights[static_cast<std::size_t>(n)] <
                                 terrain.dem().heights[static_cast<std::size_t>(v)] ||
                             (sweeper.IsLevel(v, n) && v < n);
      if (!from_here) continue;
      ++sweep.statistics.terrain_edges;
      const Edge edge = MakeEdge(v, n);
      if (InsideHull(terrain, sweep.hulls, edge) || !IsRidge(terrain, edge)) continue;
      const std::size_t first = sweep.screens.size();
      if (!sweeper.IsLevel(v, n)) sweeper.AppendScreens(v, n);
      sweep.candidates.push_back({edge, first, sweep.screens.size() - first});
    }
  }
  // By now the whole of each level is in: hulls of equal height may hide a few more.
  std::erase_if(sweep.candidates, [&](const Candidate& candidate) {
    return InsideHull(terrain, sweep.hulls, candidate.edge);
  });
  std::sort(sweep.candidates.begin(), sweep.candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.edge < b.edge; });
  sweep.statistics.candidates = static_cast<std::int64_t>(sweep.candidates.size());
  return sweep;
}

}  // namespace farhorizon
