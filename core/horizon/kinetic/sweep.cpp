// The plane's way down the terrain: posts, level by level, between the scene's own events
// (algorithm 3.1). No heights are perturbed. All posts of one height and all certificates that fail at it
// are one event, and what holds just below is found from the signs of the predicates just below
// (scene.h), so that between two events every edge that is on the horizon for a while is seen there:
// for sloped edges that is definition D2 itself, since a line that only touches an edge at an event is
// inside no open set of such lines. Level edges live at one event only and are asked of the scene's limit
// from above (level_sight.h): ground of their own height does not hide them.
#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/horizon/candidates.h"
#include "core/horizon/horizon_kinetic.h"
#include "core/horizon/hull_sweep.h"
#include "core/horizon/kinetic/level_sight.h"
#include "core/horizon/kinetic/scene.h"
#include "core/horizon/kinetic/trace.h"
#include "core/horizon/sweep_trace.h"

namespace farhorizon {
namespace {

using kinetic::ClusterId;
using kinetic::LevelSight;
using kinetic::Moment;
using kinetic::MovingPoint;
using kinetic::PointId;
using kinetic::Scene;

// A ridge or a border: nothing else is a corner of a hull.
bool IsConvex(const Terrain& terrain, Edge edge) {
  const Terrain::Faces faces = terrain.FacesOf(edge);
  return !faces.left || !faces.right ||
         Convexity(terrain.Point(edge.a), terrain.Point(edge.b), terrain.Point(*faces.left),
                   terrain.Point(*faces.right)) > 0;
}

class Sweep {
 public:
  /// checks: whether to look at all of the scene's invariants after every step.
  Sweep(const Terrain& terrain, const Watch& watch, std::int64_t work_budget, bool checks)
      : terrain_(terrain), watch_(watch), work_budget_(work_budget), checks_(checks) {
    const auto posts = static_cast<std::size_t>(terrain.post_count());
    cluster_.assign(posts, -1);
    arriving_.resize(posts);
    for (VertexId v = 0; v < terrain.post_count(); ++v) {
      if (terrain.IsVertex(v)) order_.push_back(v);
    }
    std::sort(order_.begin(), order_.end(), [this](VertexId a, VertexId b) {
      return Height(a) != Height(b) ? Height(a) > Height(b) : a < b;
    });
    summit_ = Height(order_.front());
  }

  // Whether the largest coefficient of any predicate, an orientation's, leaves room for its sums.
  [[nodiscard]] bool Fits() const {
    const auto extent =
        static_cast<unsigned>(std::max(terrain_.dem().columns, terrain_.dem().rows));
    const auto range = static_cast<unsigned>(summit_ - Height(order_.back()));
    return 2 * std::bit_width(extent) + 3 * std::bit_width(range) + 6 <= 124;
  }

  /// Down to depth `last`, its own events included. False where the watch said stop or the budget was
  /// spent.
  bool Run(std::int64_t last = kinetic::kNever) {
    watch_.Report(Stage::kKineticSweep, 0);
    std::size_t next = 0;
    while (next < order_.size() && DepthOf(order_[next]) <= last) {
      const std::int64_t s = DepthOf(order_[next]);
      if (!SinkTo(s) || !MayGoOn()) return false;
      std::size_t end = next + 1;
      while (end < order_.size() && DepthOf(order_[end]) == s) ++end;
      Report(static_cast<double>(end) / static_cast<double>(order_.size()));
      LookAtLevelEdges(next, end, s);
      scene_.Advance(Moment::At(s));
      PassPosts(next, end, s);
      Settle();
      events_.queue_max = std::max(
          events_.queue_max, scene_.queue_size() + static_cast<std::int64_t>(order_.size() - end));
      next = end;
    }
    if (last != kinetic::kNever) {
      if (!SinkTo(last)) return false;
      scene_.Advance(Moment::At(last));
      Settle();
    }
    watch_.Report(Stage::kKineticSweep, 1);
    return true;
  }

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] std::int32_t summit() const { return summit_; }
  [[nodiscard]] std::int32_t lowest() const { return Height(order_.back()); }

  [[nodiscard]] bool OverBudget() const {
    return events_.work > work_budget_ ||
           static_cast<std::int64_t>(scene_.apart().size()) > kMostKineticHulls;
  }

  KineticHorizon Take() {
    for (PointId p = 0; p < scene_.point_count(); ++p) {
      const Scene::Point& point = scene_.point(p);
      if (point.seen && point.tag >= 0) {
        result_.edges.push_back(edges_[static_cast<std::size_t>(point.tag)]);
      }
    }
    std::sort(result_.edges.begin(), result_.edges.end());
    const kinetic::SceneCounts& counts = scene_.counts();
    events_.merge = counts.merges;
    events_.hull = counts.hull_failures + counts.left_hulls;
    events_.inside = counts.inside_failures - counts.left_hulls;
    events_.by_kind = counts.tangent_failures;
    for (const std::int64_t n : counts.tangent_failures) events_.bitangent += n;
    events_.clusters_max = counts.clusters_max;
    result_.events = events_;
    return std::move(result_);
  }

 private:
  // Every height is an event; a report a percent is enough.
  void Report(double done) {
    if (done < reported_ + 0.01) return;
    reported_ = done;
    watch_.Report(Stage::kKineticSweep, done);
  }
  [[nodiscard]] std::int32_t Height(VertexId v) const { return terrain_.Point(v).z; }
  [[nodiscard]] std::int64_t DepthOf(VertexId v) const { return std::int64_t{summit_} - Height(v); }

  // Handles the scene's own events before depth s.
  bool SinkTo(std::int64_t s) {
    std::optional<Moment> at = scene_.NextFailure();
    for (; at && Compare(*at, Moment::At(s)) < 0; at = scene_.NextFailure()) {
      if (!MayGoOn()) return false;
      scene_.Advance(*at);
      Settle();
    }
    return true;
  }

  void Settle() {
    scene_.Settle();
    if (checks_) scene_.CheckAll();
  }

  // Counts a stop of the plane: all hulls are looked at there.
  bool MayGoOn() {
    events_.work += static_cast<std::int64_t>(scene_.apart().size()) + 1;
    return !OverBudget() && !watch_.StopRequested();
  }

  void LookAtLevelEdges(std::size_t next, std::size_t end, std::int64_t s) {
    std::optional<LevelSight> sight;
    for (std::size_t i = next; i < end; ++i) {
      const VertexId v = order_[i];
      for (const VertexId n : terrain_.NeighboursOf(v)) {
        if (n < v || Height(n) != Height(v) || !IsConvex(terrain_, {v, n})) continue;
        if (!sight) sight.emplace(scene_, s);
        if (sight->Sees(terrain_.Point(v), terrain_.Point(n))) result_.edges.push_back({v, n});
      }
    }
  }

  void PassPosts(std::size_t next, std::size_t end, std::int64_t s) {
    around_.clear();
    for (std::size_t i = next; i < end; ++i) {
      around_.push_back(HasHigherNeighbour(order_[i]) ? -1
                                                      : scene_.Around(terrain_.Point(order_[i]).x,
                                                                      terrain_.Point(order_[i]).y));
    }
    for (std::size_t i = next; i < end; ++i) {
      for (const PointId p : arriving_[static_cast<std::size_t>(order_[i])]) scene_.Remove(p);
      Connect(order_[i], around_[i - next]);
    }
    for (std::size_t i = next; i < end; ++i) Continue(order_[i], s);
  }

  [[nodiscard]] bool HasHigherNeighbour(VertexId v) const {
    const Terrain::Neighbours around = terrain_.NeighboursOf(v);
    return std::any_of(around.begin(), around.end(),
                       [&](VertexId n) { return Height(n) > Height(v); });
  }

  // Puts v into the cluster of what is connected with it or, a peak, around it, or into a new one.
  void Connect(VertexId v, ClusterId around) {
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
    const bool peak = mine < 0 && around < 0;
    if (mine < 0) mine = around >= 0 ? scene_.Find(around) : scene_.NewCluster();
    cluster_[static_cast<std::size_t>(v)] = mine;
    ++(peak ? events_.peak : joins ? events_.saddle : minimum ? events_.minimum : events_.regular);
  }

  // Sends points down the convex edges from v; one stays at v where it is on the border, since the
  // slice ends there.
  void Continue(VertexId v, std::int64_t s) {
    const ClusterId c = cluster_[static_cast<std::size_t>(v)];
    bool border = false;
    for (const VertexId n : terrain_.NeighboursOf(v)) {
      const Edge edge = MakeEdge(v, n);
      const Terrain::Faces faces = terrain_.FacesOf(edge);
      border = border || !faces.left || !faces.right;
      if (DepthOf(n) <= s || !IsConvex(terrain_, edge)) continue;
      const auto tag = static_cast<std::int32_t>(edges_.size());
      edges_.push_back(edge);
      const PointId p = scene_.Add(
          c, MovingPoint::Sliding(terrain_.Point(v), terrain_.Point(n), summit_), DepthOf(n), tag);
      arriving_[static_cast<std::size_t>(n)].push_back(p);
    }
    if (border) {
      scene_.Add(c, MovingPoint::Standing(terrain_.Point(v).x, terrain_.Point(v).y),
                 kinetic::kNever, -1);
    }
  }

  const Terrain& terrain_;
  const Watch& watch_;
  double reported_ = 0;
  std::int64_t work_budget_;
  bool checks_;
  Scene scene_;
  std::int32_t summit_ = 0;
  std::vector<VertexId> order_;                 // from the summit down
  std::vector<ClusterId> cluster_;              // per post; -1 below the plane
  std::vector<std::vector<PointId>> arriving_;  // per post: points whose edges end there
  std::vector<ClusterId> around_;
  std::vector<Edge> edges_;  // by tag
  EventCounts events_;
  KineticHorizon result_;
};

}  // namespace

std::int64_t DefaultKineticWorkBudget(std::int64_t terrain_edges) {
  constexpr std::int64_t kPerEdge = 200;
  constexpr std::int64_t kLeast = 50'000'000;
  return std::max(kLeast, kPerEdge * terrain_edges);
}

namespace {

Error TooLarge() {
  return {ErrorCode::kUnsupportedData,
          "extent and range of heights are too large for the kinetic engine's numbers; take the "
          "adaptive engine, or round the heights to a coarser unit",
          "kinetic-too-large"};
}

// Why Run() was false.
Error Stopped(const Sweep& sweep, std::int64_t budget) {
  if (!sweep.OverBudget()) return {ErrorCode::kCancelled, "stopped during the kinetic sweep"};
  return {ErrorCode::kResourceExhausted,
          "the kinetic engine's work budget of " + std::to_string(budget) +
              " is spent, or more than " + std::to_string(kMostKineticHulls) +
              " hulls are apart: white noise and forests of spikes do that; take the adaptive "
              "engine, raise the work budget, or smooth the heights",
          "work-budget"};
}

Result<KineticHorizon> Find(const Terrain& terrain, const Watch& watch, std::int64_t budget,
                            bool checks) {
  Sweep sweep(terrain, watch, budget, checks);
  if (!sweep.Fits()) return TooLarge();
  if (!sweep.Run()) return Stopped(sweep, budget);
  return sweep.Take();
}

}  // namespace

Result<KineticHorizon> FindHorizonKinetic(const Terrain& terrain, const Watch& watch,
                                          std::optional<std::int64_t> work_budget) {
  return Find(terrain, watch, work_budget.value_or(DefaultKineticWorkBudget(terrain.CountEdges())),
              false);
}

Result<KineticHorizon> FindHorizonKineticChecked(const Terrain& terrain) {
  return Find(terrain, {}, DefaultKineticWorkBudget(terrain.CountEdges()), true);
}

Result<SweepTrace> TraceSweep(const Terrain& terrain, std::int32_t level, const Watch& watch) {
  const std::int64_t budget = DefaultKineticWorkBudget(terrain.CountEdges());
  Sweep sweep(terrain, watch, budget, false);
  if (level > sweep.summit() || level < sweep.lowest()) {
    return Error{ErrorCode::kInvalidArgument, "the terrain has no slice at this level",
                 "no-such-level"};
  }
  if (!sweep.Fits()) return TooLarge();
  const std::int64_t s = std::int64_t{sweep.summit()} - level;
  if (!sweep.Run(s)) return Stopped(sweep, budget);
  Result<HullSweep> hulls = SweepHulls(terrain, 1, watch);
  if (!hulls) return std::move(hulls.error());
  Result<Candidates> culled = FindCandidates(terrain, *hulls, 1, watch);
  if (!culled) return std::move(culled.error());
  SweepTrace trace;
  trace.level = level;
  trace.columns = terrain.dem().columns;
  trace.rows = terrain.dem().rows;
  trace.contours = ContoursAt(terrain, level);
  for (const Candidate& candidate : culled->edges) {
    const Point3i a = terrain.Point(candidate.edge.a);
    const Point3i b = terrain.Point(candidate.edge.b);
    if (std::max(a.z, b.z) < level || std::min(a.z, b.z) > level) continue;
    trace.candidates.push_back({PlanPoint{static_cast<double>(a.x), static_cast<double>(a.y)},
                                PlanPoint{static_cast<double>(b.x), static_cast<double>(b.y)}});
  }
  kinetic::TraceScene(sweep.scene(), s, trace);
  return trace;
}

}  // namespace farhorizon
