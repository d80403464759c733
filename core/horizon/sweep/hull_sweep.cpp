// The descending plane with merged hulls. Connected ground at or above the plane hides every line that
// meets its convex hull, and hulls that touch hide what their common hull does; so the ground is known
// by a few disjoint convex polygons, which only grow and merge. A post is covered from the level on at
// which one of them takes it in. [Archambault03, chapter 3] with contours replaced by merged hulls.
#include "core/horizon/sweep/hull_sweep.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "core/geometry/convex_polygon.h"
#include "core/geometry/union_find.h"
#include "core/horizon/sweep/sweep_order.h"

namespace farhorizon {
namespace {

class Sweeper {
 public:
  Sweeper(const Terrain& terrain, const SweepOrder& order, HullSweep& result)
      : terrain_(terrain),
        order_(order),
        columns_(terrain.dem().columns),
        result_(result),
        scene_(terrain.dem().columns, terrain.dem().rows) {
    const auto posts = static_cast<std::size_t>(terrain.post_count());
    result.hulls.enclosed_height.assign(posts, kNoHeight);
    result.hulls.cluster.assign(posts, -1);
    next_uncovered_.resize(static_cast<std::size_t>(columns_ + 1) *
                           static_cast<std::size_t>(terrain.dem().rows));
    for (std::size_t i = 0; i < next_uncovered_.size(); ++i) {
      next_uncovered_[i] = static_cast<std::int32_t>(i % static_cast<std::size_t>(columns_ + 1));
    }
  }

  // Fetches what Insert will read: vertices of one height are anywhere. (g++ takes calls of functions that
  // only prefetch for calls of nothing.)
  [[gnu::always_inline]] void Expect(VertexId v) const {
    const auto post = static_cast<std::ptrdiff_t>(v);
    const std::int32_t* cluster = result_.hulls.cluster.data() + post;
    __builtin_prefetch(order_.around.data() + post);
    __builtin_prefetch(terrain_.dem().heights.data() + post);
    __builtin_prefetch(cluster);
    if (v >= columns_) __builtin_prefetch(cluster - columns_);
    if (v + columns_ < terrain_.post_count()) __builtin_prefetch(cluster + columns_);
  }

  void Insert(VertexId v) {
    v_ = v;
    level_ = Height(v);
    std::vector<std::int32_t>& met = met_;
    met.clear();
    const SweepOrder::Around& beside = order_.around[static_cast<std::size_t>(v)];
    for (unsigned before = beside.before; before != 0; before &= before - 1) {
      const VertexId n = v + order_.offsets[static_cast<std::size_t>(std::countr_zero(before))];
      const std::int32_t cluster = Find(result_.hulls.cluster[static_cast<std::size_t>(n)]);
      if (std::find(met.begin(), met.end(), cluster) == met.end()) met.push_back(cluster);
    }
    HorizonStatistics& statistics = result_.statistics;
    statistics.terrain_edges += std::popcount(beside.before);
    ++(met.empty()          ? statistics.peaks
       : met.size() > 1     ? statistics.saddles
       : !beside.some_after ? statistics.minima
                            : statistics.regular);
    const std::int32_t around = result_.hulls.cluster[static_cast<std::size_t>(v)];
    if (around >= 0 && std::find(met.begin(), met.end(), Find(around)) == met.end()) {
      met.push_back(Find(around));
    }
    if (met.empty()) {
      StartHull(v);
      return;
    }
    // Touching hulls are one already, so neighbours can only be in different ones across this post.
    std::int32_t cluster = met.front();
    for (std::size_t i = 1; i < met.size(); ++i) cluster = Merge(cluster, met[i]);
    if (around < 0) ExtendHull(cluster, PointOf(v));
  }

  [[nodiscard]] const HullScene& scene() const { return scene_; }

 private:
  [[nodiscard]] std::int32_t Height(VertexId v) const {
    return terrain_.dem().heights[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] Point2i PointOf(VertexId v) const { return {v % columns_, v / columns_}; }

  std::int32_t Find(std::int32_t node) { return FindRoot(roots_, node); }

  [[nodiscard]] std::int32_t& PlaceOf(std::int32_t node) {
    return places_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] const ConvexPolygon& HullOf(std::int32_t node) {
    return scene_.hull(PlaceOf(node));
  }

  void Change(const HullChange& change) {
    scene_.Apply(change);
    result_.changes.push_back({change, v_});
  }

  void StartHull(VertexId v) {
    const auto node = static_cast<std::int32_t>(roots_.size());
    const auto place = static_cast<std::int32_t>(nodes_.size());
    roots_.push_back(node);
    places_.push_back(place);
    nodes_.push_back(node);
    result_.hulls.parent.push_back(-1);
    result_.hulls.merge_height.push_back(kNoHeight);
    Change({HullChange::Kind::kBirth, place, 0, PointOf(v)});
    ++result_.statistics.births;
    result_.statistics.clusters_max =
        std::max(result_.statistics.clusters_max, static_cast<std::int64_t>(nodes_.size()));
    Cover(HullOf(node), node);
  }

  // Joins two clusters under the one with more corners and returns it.
  std::int32_t Merge(std::int32_t a, std::int32_t b) {
    a = Find(a);
    b = Find(b);
    if (a == b) return a;
    if (HullOf(a).corners().size() < HullOf(b).corners().size()) std::swap(a, b);
    const std::int32_t lost = PlaceOf(b);
    Change({HullChange::Kind::kMerge, PlaceOf(a), lost, {}});
    nodes_[static_cast<std::size_t>(lost)] = nodes_.back();
    PlaceOf(nodes_.back()) = lost;
    nodes_.pop_back();
    roots_[static_cast<std::size_t>(b)] = a;
    result_.hulls.parent[static_cast<std::size_t>(b)] = a;
    result_.hulls.merge_height[static_cast<std::size_t>(b)] = level_;
    ++result_.statistics.merges;
    const ConvexPolygon hull = HullOf(a);
    Cover(hull, a);
    return MergeWithWhatMeets(a, hull);
  }

  void ExtendHull(std::int32_t cluster, Point2i p) {
    if (HullOf(cluster).Contains(p)) return;
    ++result_.statistics.hull_changes;
    Change({HullChange::Kind::kGrowth, PlaceOf(cluster), 0, p});
    // What is new lies in the triangle of the new corner and its neighbours.
    const std::vector<Point2i>& ring = HullOf(cluster).corners();
    const auto at = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), p) - ring.begin());
    std::vector<Point2i> added = {ring[(at + ring.size() - 1) % ring.size()], p,
                                  ring[(at + 1) % ring.size()]};
    const ConvexPolygon growth = ConvexPolygon::HullOf(added);
    Cover(growth, cluster);
    MergeWithWhatMeets(cluster, growth);
  }

  // The cluster after it has taken in all others that meet `growth`, the part of it that is new.
  std::int32_t MergeWithWhatMeets(std::int32_t cluster, const ConvexPolygon& growth) {
    const std::int32_t own = PlaceOf(cluster);
    const std::int32_t other = scene_.index().Find(
        growth.least(), growth.most(),
        [&](std::int32_t place) { return place != own && scene_.hull(place).Meets(growth); });
    return other < 0 ? cluster : Merge(cluster, nodes_[static_cast<std::size_t>(other)]);
  }

  // Marks the posts in `polygon` that no cluster covers yet.
  void Cover(const ConvexPolygon& polygon, std::int32_t node) {
    polygon.ForEachRow([&](std::int32_t row, std::int32_t first, std::int32_t last) {
      const auto width = static_cast<std::size_t>(columns_) + 1;
      const std::span<std::int32_t> next(
          next_uncovered_.data() + static_cast<std::size_t>(row) * width, width);
      for (std::int32_t column = FindRoot(next, first); column <= last;
           column = FindRoot(next, column)) {
        const VertexId id = row * columns_ + column;
        const auto post = static_cast<std::size_t>(id);
        result_.hulls.enclosed_height[post] = level_;
        result_.hulls.cluster[post] = node;
        next[static_cast<std::size_t>(column)] = column + 1;
      }
    });
  }

  const Terrain& terrain_;
  const SweepOrder& order_;
  std::int32_t columns_;
  HullSweep& result_;
  HullScene scene_;
  std::int32_t level_ = 0;
  VertexId v_ = 0;
  std::vector<std::int32_t> roots_;           // union-find over nodes
  std::vector<std::int32_t> places_;          // of each root its place in the scene
  std::vector<std::int32_t> nodes_;           // the other way round
  std::vector<std::int32_t> next_uncovered_;  // per row, columns + 1: union-find to the right
  std::vector<std::int32_t> met_;
};

}  // namespace

Result<HullSweep> SweepHulls(const Terrain& terrain, int threads, const Watch& watch) {
  // Few enough for their scenes to be small beside the terrain, many enough to keep all threads busy.
  constexpr std::size_t kLandmarks = 64;
  constexpr std::size_t kAhead = 16;
  constexpr double kOrder = 0.1;  // the share of the stage's time that finding the order takes
  const Error stopped{ErrorCode::kCancelled, "stopped during the sweep"};
  watch.Report(Stage::kSweep, 0);
  const std::optional<SweepOrder> order = OrderOfSweep(terrain, threads, watch.Between(0, kOrder));
  if (!order) return stopped;
  const Watch inserting = watch.Between(kOrder, 1);
  const std::vector<VertexId>& vertices = order->vertices;
  const std::size_t stride = (vertices.size() + kLandmarks - 1) / kLandmarks;
  HullSweep sweep;
  Sweeper sweeper(terrain, *order, sweep);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (i % stride == 0) {
      if (watch.StopRequested()) return stopped;
      inserting.Report(Stage::kSweep,
                       static_cast<double>(i) / static_cast<double>(vertices.size()));
      sweep.checkpoints.push_back({vertices[i], sweep.changes.size(), sweeper.scene()});
    }
    if (i + kAhead < vertices.size()) sweeper.Expect(vertices[i + kAhead]);
    sweeper.Insert(vertices[i]);
  }
  watch.Report(Stage::kSweep, 1);
  return sweep;
}

}  // namespace farhorizon
