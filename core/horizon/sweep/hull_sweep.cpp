// The falling plane with merged hulls (core/horizon/README.md, theorem 4). A line that crosses the
// convex hull of connected ground at or above the plane meets this ground, and hulls that touch act
// as their common hull does. So a few disjoint convex polygons stand for all ground at or above the
// plane; they only grow and merge. A post is enclosed from the height on at which one of them
// contains it. After [Archambault03, chapter 3], with merged hulls in place of contours.
// Cost: O(n log n) and, for each change of a hull, its corners and the hulls near it.
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

// A hull is known by two numbers: its node in the merge tree, which stays, and its slot in the
// scene, which changes when the last hull moves to the slot of an absorbed one.
class Sweeper {
 public:
  using NodeId = HullMergeTree::NodeId;

  Sweeper(const Terrain& terrain, const SweepOrder& order, HullSweep& result)
      : terrain_(terrain),
        order_(order),
        columns_(terrain.dem().columns),
        result_(result),
        scene_(terrain.dem().columns, terrain.dem().rows) {
    result.hulls = HullMergeTree(terrain.post_count());
    next_open_.resize(static_cast<std::size_t>(columns_ + 1) *
                      static_cast<std::size_t>(terrain.dem().rows));
    for (std::size_t i = 0; i < next_open_.size(); ++i) {
      next_open_[i] = static_cast<std::int32_t>(i % static_cast<std::size_t>(columns_ + 1));
    }
  }

  // Fetches what Insert will read: vertices of one height are anywhere in memory. (g++ removes
  // calls of functions that do nothing but prefetch, hence the attribute.)
  [[gnu::always_inline]] void Prefetch(VertexId v) const {
    const auto post = static_cast<std::ptrdiff_t>(v);
    const NodeId* node = result_.hulls.nodes_of_posts().data() + post;
    __builtin_prefetch(order_.neighbour_orders.data() + post);
    __builtin_prefetch(terrain_.dem().heights.data() + post);
    __builtin_prefetch(node);
    if (v >= columns_) __builtin_prefetch(node - columns_);
    if (v + columns_ < terrain_.post_count()) __builtin_prefetch(node + columns_);
  }

  // Lowers the plane past v.
  void Insert(VertexId v) {
    v_ = v;
    height_ = Height(v);
    const SweepOrder::NeighbourOrder& neighbours =
        order_.neighbour_orders[static_cast<std::size_t>(v)];
    // The hulls of the ground that v joins: each one once.
    std::vector<NodeId>& joined = joined_;
    joined.clear();
    for (unsigned before = neighbours.before; before != 0; before &= before - 1) {
      const VertexId n = v + order_.offsets[static_cast<std::size_t>(std::countr_zero(before))];
      const NodeId node = RootOf(result_.hulls.NodeOf(n));
      if (std::find(joined.begin(), joined.end(), node) == joined.end()) joined.push_back(node);
    }
    HorizonStatistics& statistics = result_.statistics;
    statistics.terrain_edges += std::popcount(neighbours.before);
    ++(joined.empty()           ? statistics.peaks
       : joined.size() > 1      ? statistics.saddles
       : !neighbours.some_after ? statistics.minima
                                : statistics.regular);
    const NodeId around = result_.hulls.NodeOf(v);
    if (around >= 0 && std::find(joined.begin(), joined.end(), RootOf(around)) == joined.end()) {
      joined.push_back(RootOf(around));
    }
    if (joined.empty()) {
      StartHull(v);
      return;
    }
    // Hulls that touch are one hull already. So different hulls join only across v.
    NodeId node = joined.front();
    for (std::size_t i = 1; i < joined.size(); ++i) node = Merge(node, joined[i]);
    if (around < 0) ExtendHull(node, PointOf(v));
  }

  [[nodiscard]] const HullScene& scene() const { return scene_; }

 private:
  [[nodiscard]] std::int32_t Height(VertexId v) const {
    return terrain_.dem().heights[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] Point2i PointOf(VertexId v) const { return {v % columns_, v / columns_}; }

  NodeId RootOf(NodeId node) { return FindRoot(roots_, node); }

  [[nodiscard]] std::int32_t& SlotOf(NodeId node) { return slots_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] const ConvexPolygon& HullOf(NodeId node) { return scene_.hull(SlotOf(node)); }

  void Change(const HullChange& change) {
    scene_.Apply(change);
    result_.history.Append(v_, change);
  }

  void StartHull(VertexId v) {
    const NodeId node = result_.hulls.AddNode();
    const auto slot = static_cast<std::int32_t>(nodes_.size());
    roots_.push_back(node);
    slots_.push_back(slot);
    nodes_.push_back(node);
    Change({HullChange::Kind::kStart, slot, 0, PointOf(v)});
    ++result_.statistics.births;
    result_.statistics.clusters_max =
        std::max(result_.statistics.clusters_max, static_cast<std::int64_t>(nodes_.size()));
    EnclosePosts(HullOf(node), node);
  }

  // Joins two hulls, and all that the joined hull meets; returns the node.
  NodeId Merge(NodeId a, NodeId b) {
    std::vector<ConvexPolygon> grown;
    const NodeId node = Join(a, b, grown);
    return MergeAllThatMeet(node, std::move(grown));
  }

  void ExtendHull(NodeId node, Point2i p) {
    if (HullOf(node).Contains(p)) return;
    ++result_.statistics.hull_changes;
    Change({HullChange::Kind::kExtension, SlotOf(node), 0, p});
    // The new part of the hull lies in the triangle of the new corner and its two neighbours.
    const std::vector<Point2i>& ring = HullOf(node).corners();
    const auto at = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), p) - ring.begin());
    std::vector<Point2i> corners = {ring[(at + ring.size() - 1) % ring.size()], p,
                                    ring[(at + 1) % ring.size()]};
    std::vector<ConvexPolygon> grown = {ConvexPolygon::HullOf(corners)};
    EnclosePosts(grown.front(), node);
    MergeAllThatMeet(node, std::move(grown));
  }

  // Joins two hulls under the node of the one with more corners and returns the node. Appends to
  // `grown` a polygon of the joined hull that contains all of it that is in neither.
  NodeId Join(NodeId a, NodeId b, std::vector<ConvexPolygon>& grown) {
    a = RootOf(a);
    b = RootOf(b);
    if (a == b) return a;
    if (HullOf(a).corners().size() < HullOf(b).corners().size()) std::swap(a, b);
    const std::int32_t absorbed = SlotOf(b);
    std::vector<Point2i> absorbed_corners = HullOf(b).corners();
    Change({HullChange::Kind::kMerge, SlotOf(a), absorbed, {}});
    nodes_[static_cast<std::size_t>(absorbed)] = nodes_.back();
    SlotOf(nodes_.back()) = absorbed;
    nodes_.pop_back();
    roots_[static_cast<std::size_t>(b)] = a;
    result_.hulls.Merge(b, a, height_);
    ++result_.statistics.merges;
    grown.push_back(GrownPart(HullOf(a).corners(), std::move(absorbed_corners)));
    EnclosePosts(grown.back(), a);
    return a;
  }

  // Where the hull of corners `ring` is larger than the two that it was joined from. Corners of the
  // absorbed hull come in runs along the ring, between corners of the other one:
  //
  //        the other   a1 .----. b    absorbed       What is new lies in the polygons of a run and
  //        one's old   |    )   `.                   of the two corners beside it: the other hull
  //        border      |    )    : b                 is convex, so all of it beyond the line from
  //                    a2 '----'                     a1 to a2 is old. The hull of these corners
  //                                                  contains the polygons.
  static ConvexPolygon GrownPart(const std::vector<Point2i>& ring, std::vector<Point2i> absorbed) {
    std::sort(absorbed.begin(), absorbed.end());
    std::vector<Point2i> corners = absorbed;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (!std::binary_search(absorbed.begin(), absorbed.end(), ring[i])) continue;
      corners.push_back(ring[(i + ring.size() - 1) % ring.size()]);
      corners.push_back(ring[(i + 1) % ring.size()]);
    }
    return ConvexPolygon::HullOf(corners);
  }

  // Joins to the hull `node` all others that meet one of `grown`, new parts of the hull, or what is
  // new by these merges; returns the node after the last merge. Each part is compared once: only
  // this hull grows.
  NodeId MergeAllThatMeet(NodeId node, std::vector<ConvexPolygon> grown) {
    std::vector<NodeId> met;
    while (!grown.empty()) {
      const ConvexPolygon part = std::move(grown.back());
      grown.pop_back();
      met.clear();
      const std::int32_t own = SlotOf(node);
      scene_.index().ForEach(part.least(), part.most(), [&](std::int32_t slot) {
        if (slot != own && scene_.hull(slot).Meets(part)) {
          met.push_back(nodes_[static_cast<std::size_t>(slot)]);
        }
      });
      for (const NodeId other : met) node = Join(node, other, grown);
    }
    return node;
  }

  // Enters the posts in `polygon` that no hull encloses yet.
  void EnclosePosts(const ConvexPolygon& polygon, NodeId node) {
    polygon.ForEachRow([&](std::int32_t row, std::int32_t first, std::int32_t last) {
      const auto width = static_cast<std::size_t>(columns_) + 1;
      const std::span<std::int32_t> next(next_open_.data() + static_cast<std::size_t>(row) * width,
                                         width);
      for (std::int32_t column = FindRoot(next, first); column <= last;
           column = FindRoot(next, column)) {
        result_.hulls.Enclose(row * columns_ + column, node, height_);
        next[static_cast<std::size_t>(column)] = column + 1;
      }
    });
  }

  const Terrain& terrain_;
  const SweepOrder& order_;
  std::int32_t columns_;
  HullSweep& result_;
  HullScene scene_;
  std::int32_t height_ = 0;          // of the plane
  VertexId v_ = 0;                   // the vertex that it passes
  std::vector<NodeId> roots_;        // union-find over nodes
  std::vector<std::int32_t> slots_;  // per root: its slot in the scene
  std::vector<NodeId> nodes_;        // per slot: its root
  // Per row, columns + 1 entries: union-find whose roots are the posts that no hull encloses, each
  // post in the set of the next such post to the right.
  std::vector<std::int32_t> next_open_;
  std::vector<NodeId> joined_;
};

}  // namespace

Result<HullSweep> SweepHulls(const Terrain& terrain, int threads, const RunControl& control) {
  // Any values are sound. So many states keep many threads busy; the vertex so far ahead is in the
  // cache when its turn comes.
  constexpr std::size_t kStates = 64;
  constexpr std::size_t kAhead = 16;
  constexpr double kOrder = 0.1;  // the share of the stage's time that finding the order takes
  const Error stopped{ErrorCode::kCancelled, "stopped during the sweep"};
  control.Report(Stage::kSweep, 0);
  const std::optional<SweepOrder> order =
      OrderOfSweep(terrain, threads, control.Between(0, kOrder));
  if (!order) return stopped;
  const RunControl inserting = control.Between(kOrder, 1);
  const std::vector<VertexId>& vertices = order->vertices;
  const std::size_t stride = (vertices.size() + kStates - 1) / kStates;
  HullSweep sweep{HullHistory(terrain.dem().columns, terrain.dem().rows), {}, {}};
  Sweeper sweeper(terrain, *order, sweep);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (i % stride == 0) {
      if (control.StopRequested()) return stopped;
      inserting.Report(Stage::kSweep,
                       static_cast<double>(i) / static_cast<double>(vertices.size()));
      sweep.history.OfferState(vertices[i], sweeper.scene());
    }
    if (i + kAhead < vertices.size()) sweeper.Prefetch(vertices[i + kAhead]);
    sweeper.Insert(vertices[i]);
  }
  control.Report(Stage::kSweep, 1);
  return sweep;
}

}  // namespace farhorizon
