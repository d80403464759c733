#include "core/horizon/sweep/candidates.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

#include "core/base/parallel_for.h"
#include "core/horizon/sweep/edge_occlusion.h"
#include "core/horizon/sweep/hull_scene.h"

namespace farhorizon {
namespace {

// Whether the ground right beside the edge leaves directions free in which to sight it: beside a ridge or
// on a border it does, but for a level edge beside which it rises.
bool IsRidge(const Terrain& terrain, Edge edge) {
  const Terrain::Faces faces = terrain.FacesOf(edge);
  const Point3i a = terrain.Point(edge.a);
  const Point3i b = terrain.Point(edge.b);
  if (a.z == b.z) {
    const auto rises = [&](const std::optional<VertexId>& third) {
      return third && terrain.Point(*third).z > a.z;
    };
    if (rises(faces.left) || rises(faces.right)) return false;
  }
  return terrain.IsRidgeOrBorder(edge, faces);
}

// Whether the edge is inside the hull of the ground at or above it. Level edges ask for the hull of
// strictly higher ground: ground of their own height does not hide them.
bool InsideHull(const Terrain& terrain, const HullMergeTree& hulls, Edge edge) {
  const std::int32_t a = terrain.Point(edge.a).z;
  const std::int32_t b = terrain.Point(edge.b).z;
  return hulls.Hides(edge.a, edge.b, a == b ? a + 1 : std::max(a, b));
}

// When the plane is past the vertex from which an edge is looked at: rising in the order of the sweep.
using Moment = std::uint64_t;

constexpr VertexId kBeforeAll = -1;

Moment MomentOf(std::int32_t height, VertexId v) {
  const std::int64_t depth = std::int64_t{std::numeric_limits<std::int32_t>::max()} - height;
  return (static_cast<Moment>(depth) << 32) | static_cast<Moment>(v + 1);
}

// An edge that the hulls at the end of the sweep leave, and its higher end. Level edges are hidden by
// strictly higher ground alone, so they look at the hulls before the first vertex of their height.
struct Survivor {
  Moment moment;
  VertexId high;
  VertexId low;

  friend bool operator<(const Survivor& a, const Survivor& b) {
    return std::tie(a.moment, a.high, a.low) < std::tie(b.moment, b.high, b.low);
  }
};

class CandidateSearch {
 public:
  CandidateSearch(const Terrain& terrain, const HullSweep& sweep)
      : terrain_(terrain), sweep_(sweep), columns_(terrain.dem().columns) {
    for (const HullSweep::Checkpoint& landmark : sweep.checkpoints) {
      begins_.push_back(MomentOf(Height(landmark.vertex), landmark.vertex));
    }
  }

  // Of the edges from posts of these rows to later ones, those that survive, by landmark.
  [[nodiscard]] std::vector<std::vector<Survivor>> SurvivorsOf(std::int32_t first_row,
                                                               std::int32_t end_row) const {
    std::vector<std::vector<Survivor>> survivors(begins_.size());
    for (VertexId v = first_row * columns_; v < end_row * columns_; ++v) {
      for (const VertexId n : terrain_.NeighboursOf(v)) {
        if (n < v) continue;
        const Edge edge{v, n};
        if (InsideHull(terrain_, sweep_.hulls, edge) || !IsRidge(terrain_, edge)) continue;
        const bool level = Height(v) == Height(n);
        const VertexId high = Height(n) > Height(v) ? n : v;
        const Moment moment = MomentOf(Height(high), level ? kBeforeAll : high);
        const auto later = std::upper_bound(begins_.begin(), begins_.end(), moment);
        const auto part = later == begins_.begin() ? later : later - 1;
        survivors[static_cast<std::size_t>(part - begins_.begin())].push_back(
            {moment, high, high == v ? n : v});
      }
    }
    return survivors;
  }

  // Those of the survivors, which lie between a landmark and the next, that the hulls of their moment leave.
  [[nodiscard]] Candidates CandidatesOf(std::size_t landmark,
                                        std::vector<Survivor>& survivors) const {
    std::sort(survivors.begin(), survivors.end());
    Candidates found;
    HullScene scene = sweep_.checkpoints[landmark].scene;
    std::size_t next = sweep_.checkpoints[landmark].next_change;
    for (const Survivor& survivor : survivors) {
      for (; next < sweep_.changes.size(); ++next) {
        const HullSweep::Change& change = sweep_.changes[next];
        if (MomentOf(Height(change.by), change.by) > survivor.moment) break;
        scene.Apply(change.hulls);
      }
      Consider(survivor, scene, found);
    }
    return found;
  }

 private:
  [[nodiscard]] std::int32_t Height(VertexId v) const {
    return terrain_.dem().heights[static_cast<std::size_t>(v)];
  }

  void Consider(const Survivor& survivor, const HullScene& scene, Candidates& found) const {
    const Edge edge = MakeEdge(survivor.high, survivor.low);
    const Point3i high = terrain_.Point(survivor.high);
    const Point3i low = terrain_.Point(survivor.low);
    EdgeOcclusion shade({low.x, low.y}, {high.x, high.y}, WedgeOf(terrain_, edge));
    AddHulls(scene, high, shade);
    if (shade.IsComplete()) return;
    const std::size_t first = found.virtual_occluders.size();
    // The hulls that a level edge looks at are at least a quantum higher.
    shade.AppendVirtualOccluders(high.z == low.z ? high.z + 1 : high.z, found.virtual_occluders);
    found.edges.push_back({edge, first, found.virtual_occluders.size() - first});
  }

  // What hides most first, until all is hidden: the hull that the edge stands on, those near, the rest.
  static void AddHulls(const HullScene& scene, Point3i high, EdgeOcclusion& shade) {
    const HullIndex& index = scene.index();
    const Point2i post{high.x, high.y};
    const std::int32_t own = index.Find(
        post, post, [&](std::int32_t place) { return scene.hull(place).Contains(post); });
    if (own >= 0) shade.Add(scene.hull(own));
    const Point2i least{high.x - kNear, high.y - kNear};
    const Point2i most{high.x + kNear, high.y + kNear};
    const auto add = [&](std::int32_t place) {
      if (place != own) shade.Add(scene.hull(place));
      return shade.IsFull();
    };
    if (index.Find(least, most, add) >= 0) return;
    const auto hulls = static_cast<std::int32_t>(scene.hulls().size());
    for (std::int32_t place = 0; place < hulls && !shade.IsFull(); ++place) {
      if (!index.Meets(place, least, most)) shade.Add(scene.hull(place));
    }
  }

  static constexpr std::int32_t kNear = 24;  // posts

  const Terrain& terrain_;
  const HullSweep& sweep_;
  std::int32_t columns_;
  std::vector<Moment> begins_;  // of the checkpoints
};

}  // namespace

Result<Candidates> FindCandidates(const Terrain& terrain, const HullSweep& sweep, int threads,
                                  const Watch& watch) {
  constexpr std::size_t kRows = 32;
  constexpr double kSurvivors = 0.15;  // their share of the stage's time
  watch.Report(Stage::kCandidates, 0);
  const CandidateSearch search(terrain, sweep);
  const auto rows = static_cast<std::size_t>(terrain.dem().rows);
  std::vector<std::vector<std::vector<Survivor>>> bands((rows + kRows - 1) / kRows);
  const auto survive = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    bands[begin / kRows] =
        search.SurvivorsOf(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end));
  };
  std::vector<Candidates> parts(sweep.checkpoints.size());
  const auto look = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<Survivor> survivors;
      for (const auto& band : bands) {
        survivors.insert(survivors.end(), band[i].begin(), band[i].end());
      }
      parts[i] = search.CandidatesOf(i, survivors);
    }
  };
  if (!ParallelForBatches(rows, kRows, threads, Stage::kCandidates, watch.Between(0, kSurvivors),
                          survive) ||
      !ParallelForBatches(parts.size(), 1, threads, Stage::kCandidates,
                          watch.Between(kSurvivors, 1), look)) {
    return Error{ErrorCode::kCancelled, "stopped while looking for candidates"};
  }
  Candidates all;
  std::size_t edges = 0;
  std::size_t virtual_occluders = 0;
  for (const Candidates& part : parts) {
    edges += part.edges.size();
    virtual_occluders += part.virtual_occluders.size();
  }
  all.edges.reserve(edges);
  all.virtual_occluders.reserve(virtual_occluders);
  for (const Candidates& part : parts) {
    for (const Candidate& c : part.edges) {
      all.edges.push_back({c.edge, c.first_virtual_occluder + all.virtual_occluders.size(),
                           c.virtual_occluder_count});
    }
    all.virtual_occluders.insert(all.virtual_occluders.end(), part.virtual_occluders.begin(),
                                 part.virtual_occluders.end());
  }
  std::sort(all.edges.begin(), all.edges.end(),
            [](const Candidate& a, const Candidate& b) { return a.edge < b.edge; });
  return all;
}

}  // namespace farhorizon
