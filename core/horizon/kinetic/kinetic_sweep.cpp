// The sweep plane falls from height to height of posts; between two of these, the scene deals with
// its own events (algorithm 3.1 of [Archambault03]). No heights are perturbed. All posts of one
// height and all certificates that fail there are one event, and what is true just below is found
// from the signs of the predicates just below (neighbour_scene.h). So between two events each edge
// that is on the horizon for a while is found there; for sloped edges that is definition D2
// (core/horizon/README.md, theorem 10), since a line that only touches an edge at an event is in no
// open set of such lines. Horizontal edges are in the slice at one event only and are asked of the
// scene's limit from above (horizontal_edge_visibility.h): ground of their own height does not
// occlude them.
#include "core/horizon/kinetic/kinetic_sweep.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <string>
#include <utility>

#include "core/horizon/kinetic/bitangents/bitangent_scene.h"
#include "core/horizon/kinetic/horizontal_edge_visibility.h"
#include "core/horizon/kinetic/neighbours/neighbour_scene.h"

namespace farhorizon::kinetic {

namespace {

Error TooLarge() {
  return {ErrorCode::kUnsupportedData,
          "extent and range of heights are too large for the kinetic engine's numbers; take the "
          "adaptive engine, or round the heights to a coarser unit",
          "kinetic-too-large"};
}

}  // namespace

template <typename Scene>
KineticSweep<Scene>::KineticSweep(const Terrain& terrain, const RunControl& control,
                                  const KineticOptions& options, bool checks)
    : terrain_(terrain),
      control_(control),
      work_budget_(options.work_budget.value_or(DefaultKineticWorkBudget(terrain.CountEdges()))),
      hull_certificates_(options.hull),
      checks_(checks),
      scene_(options.hull, work_budget_),
      inside_(terrain, scene_) {
  const auto posts = static_cast<std::size_t>(terrain.post_count());
  cluster_.assign(posts, -1);
  arriving_.assign(posts, -1);
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (terrain.IsVertex(v)) order_.push_back(v);
  }
  std::sort(order_.begin(), order_.end(), [this](VertexId a, VertexId b) {
    return Height(a) != Height(b) ? Height(a) > Height(b) : a < b;
  });
  summit_ = Height(order_.front());
}

// Whether the largest coefficient of any predicate, the one of an orientation, leaves room for its
// sums; or with trees the one of the turn of two edges (core/horizon/README.md, section 7).
template <typename Scene>
bool KineticSweep<Scene>::Fits() const {
  const auto extent = static_cast<unsigned>(std::max(terrain_.dem().columns, terrain_.dem().rows));
  const auto range = static_cast<unsigned>(summit_ - Height(order_.back()));
  // bit_width gives an unsigned number until LWG 3656, an int after.
  const auto extent_bits = static_cast<int>(std::bit_width(extent));
  const auto range_bits = static_cast<int>(std::bit_width(range));
  const int factors = hull_certificates_ == HullCertificates::kTree ? 4 : 3;
  return 2 * extent_bits + factors * range_bits + 6 <= 124;
}

template <typename Scene>
bool KineticSweep<Scene>::OverBudget() const {
  return events_.work + scene_.counts().looks > work_budget_;
}

template <typename Scene>
bool KineticSweep<Scene>::MustStop() const {
  return OverBudget() || control_.StopRequested();
}

// Why SinkPast() was false.
template <typename Scene>
Error KineticSweep<Scene>::Stopped() const {
  if (!OverBudget()) return {ErrorCode::kCancelled, "stopped during the kinetic sweep"};
  return {ErrorCode::kResourceExhausted,
          "the kinetic engine's work budget of " + std::to_string(work_budget_) +
              " is spent: white noise and forests of spikes do that; take the adaptive engine, "
              "raise the work budget, or smooth the heights",
          "work-budget"};
}

template <typename Scene>
Status KineticSweep<Scene>::Run(std::int64_t last) {
  if (!Fits()) return TooLarge();
  if (!SinkPast(last)) return Stopped();
  return Ok{};
}

// Down to depth `last`, its own events included. False where a stop was requested or the budget was
// spent.
template <typename Scene>
bool KineticSweep<Scene>::SinkPast(std::int64_t last) {
  control_.Report(Stage::kKineticSweep, 0);
  std::size_t next = 0;
  while (next < order_.size() && DepthOf(order_[next]) <= last) {
    const std::int64_t s = DepthOf(order_[next]);
    if (!SinkTo(s) || !MayGoOn()) return false;
    std::size_t end = next + 1;
    while (end < order_.size() && DepthOf(order_[end]) == s) ++end;
    Report(static_cast<double>(end) / static_cast<double>(order_.size()));
    FindHorizontalEdges(next, end, s);
    if (MustStop()) return false;
    scene_.Advance(SweepDepth::At(s));
    PassPosts(next, end, s);
    if (MustStop()) return false;
    RestoreInvariants();
    if (MustStop()) return false;
    events_.queue_max = std::max(
        events_.queue_max, scene_.queue_size() + static_cast<std::int64_t>(order_.size() - end));
    next = end;
  }
  if (last != kNever) {
    if (!SinkTo(last)) return false;
    scene_.Advance(SweepDepth::At(last));
    RestoreInvariants();
  }
  control_.Report(Stage::kKineticSweep, 1);
  return !OverBudget();
}

// Every height is an event; a report a percent is enough.
template <typename Scene>
void KineticSweep<Scene>::Report(double done) {
  if (done < reported_ + 0.01) return;
  reported_ = done;
  control_.Report(Stage::kKineticSweep, done);
}

template <typename Scene>
KineticHorizon KineticSweep<Scene>::Take() {
  for (PointId p = 0; p < scene_.hulls().point_count(); ++p) {
    const std::int32_t tag = scene_.hulls().point(p).tag;
    if (scene_.OnHorizon(p) && tag >= 0) {
      result_.edges.push_back(edges_[static_cast<std::size_t>(tag)]);
    }
  }
  std::sort(result_.edges.begin(), result_.edges.end());
  const SceneCounts& counts = scene_.counts();
  events_.merge = counts.merges;
  events_.hull = counts.hull_failures + counts.left_interior;
  events_.inside = counts.interior_failures - counts.left_interior;
  events_.tree = scene_.hulls().tree_failures();
  events_.cover = counts.cover_failures;
  events_.separation = counts.separation_failures;
  events_.by_kind = counts.tangent_failures;
  events_.tangents_max = counts.tangents_max;
  events_.work += counts.looks;
  events_.clusters_max = counts.clusters_max;
  result_.events = events_;
  return std::move(result_);
}

// Deals with the scene's own events before depth s.
template <typename Scene>
bool KineticSweep<Scene>::SinkTo(std::int64_t s) {
  std::optional<SweepDepth> at = scene_.NextEvent();
  for (; at && Compare(*at, SweepDepth::At(s)) < 0; at = scene_.NextEvent()) {
    if (!MayGoOn()) return false;
    scene_.Advance(*at);
    RestoreInvariants();
  }
  return true;
}

template <typename Scene>
void KineticSweep<Scene>::RestoreInvariants() {
  scene_.RestoreInvariants();
  if (checks_ && !OverBudget()) scene_.CheckAll();
}

// Counts a stop of the plane.
template <typename Scene>
bool KineticSweep<Scene>::MayGoOn() {
  ++events_.work;
  return !MustStop();
}

// Those with both ends inside one hull of higher ground are not asked of.
template <typename Scene>
void KineticSweep<Scene>::FindHorizontalEdges(std::size_t next, std::size_t end, std::int64_t s) {
  std::optional<HorizontalEdgeVisibility<Scene>> visibility;
  for (std::size_t i = next; i < end && !MustStop(); ++i) {
    const VertexId v = order_[i];
    for (const VertexId n : terrain_.NeighboursOf(v)) {
      if (n < v || Height(n) != Height(v) || !terrain_.IsRidgeOrBorder({v, n})) continue;
      const ClusterId around = inside_.ClusterAround(v, s, events_.work);
      if (around >= 0 && inside_.IsInside(n, around, s)) continue;
      if (!visibility) visibility.emplace(scene_, s);
      if (visibility->IsVisible(terrain_.Point(v), terrain_.Point(n))) {
        result_.edges.push_back({v, n});
      }
      events_.work += visibility->TakeLooks();
    }
  }
}

template <typename Scene>
void KineticSweep<Scene>::PassPosts(std::size_t next, std::size_t end, std::int64_t s) {
  containing_.clear();  // before anything is changed at this depth
  for (std::size_t i = next; i < end; ++i) {
    if (MustStop()) return;
    containing_.push_back(
        HasHigherNeighbour(order_[i]) ? -1 : inside_.ClusterAround(order_[i], s, events_.work));
  }
  for (std::size_t i = next; i < end; ++i) {
    for (PointId p = arriving_[static_cast<std::size_t>(order_[i])]; p >= 0;
         p = arriving_too_[Index(p)]) {
      scene_.Remove(p);
    }
    Connect(order_[i], containing_[i - next]);
  }
  for (std::size_t i = next; i < end; ++i) Continue(order_[i], s);
}

template <typename Scene>
bool KineticSweep<Scene>::HasHigherNeighbour(VertexId v) const {
  const Terrain::Neighbours around = terrain_.NeighboursOf(v);
  return std::any_of(around.begin(), around.end(),
                     [&](VertexId n) { return Height(n) > Height(v); });
}

// Puts v into the cluster that its neighbours are in, once joined; a peak into the one whose hull
// contains it (-1: none), or else into a new one.
template <typename Scene>
void KineticSweep<Scene>::Connect(VertexId v, ClusterId containing) {
  ClusterId mine = -1;
  bool joins = false;
  bool minimum = true;
  for (const VertexId n : terrain_.NeighboursOf(v)) {
    const ClusterId theirs = cluster_[static_cast<std::size_t>(n)];
    minimum = minimum && theirs >= 0;
    if (theirs < 0) continue;
    joins = joins || (mine >= 0 && scene_.Find(mine) != scene_.Find(theirs));
    mine = mine < 0 ? scene_.Find(theirs) : scene_.Join(mine, theirs);
  }
  const bool peak = mine < 0 && containing < 0;
  if (mine < 0) mine = containing >= 0 ? scene_.Find(containing) : scene_.NewCluster();
  cluster_[static_cast<std::size_t>(v)] = mine;
  ++(peak ? events_.peak : joins ? events_.saddle : minimum ? events_.minimum : events_.regular);
}

// Adds a point for each convex edge down from v; at the border of the terrain, where the slice
// ends, one that stays at v, too. None for what is inside the hull and stays there: an edge that
// ends inside never comes out.
template <typename Scene>
void KineticSweep<Scene>::Continue(VertexId v, std::int64_t s) {
  const ClusterId c = scene_.Find(cluster_[static_cast<std::size_t>(v)]);
  const bool has_hull = !scene_.hulls().hull(c).joined && !scene_.hulls().corners(c).empty();
  bool border = false;
  for (const VertexId n : terrain_.NeighboursOf(v)) {
    const Edge edge = MakeEdge(v, n);
    const Terrain::Faces faces = terrain_.FacesOf(edge);
    border = border || !faces.left || !faces.right;
    if (DepthOf(n) <= s || !terrain_.IsRidgeOrBorder(edge, faces)) continue;
    if (has_hull && inside_.IsInside(n, c, s)) continue;
    const auto tag = static_cast<std::int32_t>(edges_.size());
    edges_.push_back(edge);
    const PointId p = scene_.Add(
        c, MovingPoint::Sliding(terrain_.Point(v), terrain_.Point(n), summit_), DepthOf(n), tag);
    PointId& last = arriving_[static_cast<std::size_t>(n)];
    arriving_too_.push_back(std::exchange(last, p));
  }
  if (border && !(has_hull && inside_.IsInside(v, c, s))) {
    scene_.Add(c, MovingPoint::Standing(terrain_.Point(v).x, terrain_.Point(v).y), kNever, -1);
    arriving_too_.push_back(-1);
  }
}

template class KineticSweep<NeighbourScene>;
template class KineticSweep<BitangentScene>;

}  // namespace farhorizon::kinetic
