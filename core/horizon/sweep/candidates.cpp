// The edges that can be horizon edges, after three culls. The first two need the edge and the merge
// tree only; survivors of these go to the checkpoint of the sweep before their own place in its
// order. From each checkpoint on, the changes of the sweep are replayed, and each survivor is
// compared with the hulls at its place. A sloped edge has its place after its upper vertex: ground
// at that height occludes the rest of the edge. A horizontal edge has it before the first vertex of
// its height: only ground strictly above occludes it.
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

// True for ridges and border edges, except horizontal edges with a rising face beside them
// (core/horizon/README.md, theorem 7).
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

// Whether the edge lies in one hull of the ground at or above it; for a horizontal edge, of the
// ground strictly above it (core/horizon/README.md, theorem 5).
bool InsideHull(const Terrain& terrain, const HullMergeTree& hulls, Edge edge) {
  const std::int32_t a = terrain.Point(edge.a).z;
  const std::int32_t b = terrain.Point(edge.b).z;
  return hulls.Occludes(edge.a, edge.b, a == b ? a + 1 : std::max(a, b));
}

// A place in the order of the sweep, right after a vertex: keys rise by falling height, then by
// rising number of the vertex.
using SweepKey = std::uint64_t;

SweepKey KeyAfter(std::int32_t height, VertexId v) {
  const std::int64_t depth = std::int64_t{std::numeric_limits<std::int32_t>::max()} - height;
  return (static_cast<SweepKey>(depth) << 32) | static_cast<SweepKey>(v + 1);
}

SweepKey KeyBefore(std::int32_t height) { return KeyAfter(height, -1); }

// An edge that the first two culls leave, and where in the sweep the third one takes place.
struct Survivor {
  SweepKey key;
  VertexId high;  // the upper end
  VertexId low;

  friend bool operator<(const Survivor& a, const Survivor& b) {
    return std::tie(a.key, a.high, a.low) < std::tie(b.key, b.high, b.low);
  }
};

class CandidateSearch {
 public:
  CandidateSearch(const Terrain& terrain, const HullSweep& sweep)
      : terrain_(terrain), sweep_(sweep), columns_(terrain.dem().columns) {
    for (const HullSweep::Checkpoint& checkpoint : sweep.checkpoints) {
      checkpoint_keys_.push_back(KeyAfter(Height(checkpoint.vertex), checkpoint.vertex));
    }
  }

  // The survivors among the edges from posts of these rows to later posts, by checkpoint.
  [[nodiscard]] std::vector<std::vector<Survivor>> SurvivorsOf(std::int32_t first_row,
                                                               std::int32_t end_row) const {
    std::vector<std::vector<Survivor>> survivors(checkpoint_keys_.size());
    for (VertexId v = first_row * columns_; v < end_row * columns_; ++v) {
      for (const VertexId n : terrain_.NeighboursOf(v)) {
        if (n < v) continue;
        const Edge edge{v, n};
        if (InsideHull(terrain_, sweep_.hulls, edge) || !IsRidge(terrain_, edge)) continue;
        const bool horizontal = Height(v) == Height(n);
        const VertexId high = Height(n) > Height(v) ? n : v;
        const SweepKey key = horizontal ? KeyBefore(Height(high)) : KeyAfter(Height(high), high);
        survivors[CheckpointBefore(key)].push_back({key, high, high == v ? n : v});
      }
    }
    return survivors;
  }

  // Those of the checkpoint's survivors that the third cull leaves.
  [[nodiscard]] Candidates CandidatesOf(std::size_t checkpoint,
                                        std::vector<Survivor>& survivors) const {
    std::sort(survivors.begin(), survivors.end());
    Candidates found;
    HullScene scene = sweep_.checkpoints[checkpoint].scene;
    std::size_t next = sweep_.checkpoints[checkpoint].next_change;
    for (const Survivor& survivor : survivors) {
      for (; next < sweep_.changes.size(); ++next) {
        const HullSweep::Change& change = sweep_.changes[next];
        if (KeyAfter(Height(change.by), change.by) > survivor.key) break;
        scene.Apply(change.hulls);
      }
      AddUnlessOccluded(survivor, scene, found);
    }
    return found;
  }

 private:
  [[nodiscard]] std::int32_t Height(VertexId v) const {
    return terrain_.dem().heights[static_cast<std::size_t>(v)];
  }

  // The last checkpoint at or before the key, or the first one.
  [[nodiscard]] std::size_t CheckpointBefore(SweepKey key) const {
    const auto later = std::upper_bound(checkpoint_keys_.begin(), checkpoint_keys_.end(), key);
    const auto before = later == checkpoint_keys_.begin() ? later : later - 1;
    return static_cast<std::size_t>(before - checkpoint_keys_.begin());
  }

  void AddUnlessOccluded(const Survivor& survivor, const HullScene& scene,
                         Candidates& found) const {
    const Edge edge = MakeEdge(survivor.high, survivor.low);
    const Point3i high = terrain_.Point(survivor.high);
    const Point3i low = terrain_.Point(survivor.low);
    EdgeOcclusion occlusion({low.x, low.y}, {high.x, high.y}, WedgeOf(terrain_, edge));
    AddHulls(scene, {high.x, high.y}, occlusion);
    if (occlusion.Finish()) return;
    const std::size_t first = found.virtual_occluders.size();
    // The hulls before a horizontal edge's place are at least a quantum higher than the edge.
    occlusion.AppendVirtualOccluders(high.z == low.z ? high.z + 1 : high.z,
                                     found.virtual_occluders);
    found.edges.push_back({edge, first, found.virtual_occluders.size() - first});
  }

  // Adds hulls until all directions are occluded, those that occlude most first: the hull around
  // the upper end, hulls near it, all others.
  static void AddHulls(const HullScene& scene, Point2i high, EdgeOcclusion& occlusion) {
    const HullIndex& index = scene.index();
    const std::int32_t own =
        index.Find(high, high, [&](std::int32_t slot) { return scene.hull(slot).Contains(high); });
    if (own >= 0) occlusion.Add(scene.hull(own));
    const Point2i least{high.x - kNear, high.y - kNear};
    const Point2i most{high.x + kNear, high.y + kNear};
    const auto add = [&](std::int32_t slot) {
      if (slot != own) occlusion.Add(scene.hull(slot));
      return occlusion.IsOccluded();
    };
    if (index.Find(least, most, add) >= 0) return;
    const auto hulls = static_cast<std::int32_t>(scene.hulls().size());
    for (std::int32_t slot = 0; slot < hulls && !occlusion.IsOccluded(); ++slot) {
      if (!index.BoxIntersects(slot, least, most)) occlusion.Add(scene.hull(slot));
    }
  }

  // In posts. Any value is sound; with this one most edges need no other hulls.
  static constexpr std::int32_t kNear = 24;

  const Terrain& terrain_;
  const HullSweep& sweep_;
  std::int32_t columns_;
  std::vector<SweepKey> checkpoint_keys_;
};

// All candidates, by rising edge.
Candidates Joined(const std::vector<Candidates>& by_checkpoint) {
  Candidates all;
  std::size_t edges = 0;
  std::size_t virtual_occluders = 0;
  for (const Candidates& some : by_checkpoint) {
    edges += some.edges.size();
    virtual_occluders += some.virtual_occluders.size();
  }
  all.edges.reserve(edges);
  all.virtual_occluders.reserve(virtual_occluders);
  for (const Candidates& some : by_checkpoint) {
    for (const Candidate& c : some.edges) {
      all.edges.push_back({c.edge, c.first_virtual_occluder + all.virtual_occluders.size(),
                           c.virtual_occluder_count});
    }
    all.virtual_occluders.insert(all.virtual_occluders.end(), some.virtual_occluders.begin(),
                                 some.virtual_occluders.end());
  }
  std::sort(all.edges.begin(), all.edges.end(),
            [](const Candidate& a, const Candidate& b) { return a.edge < b.edge; });
  return all;
}

}  // namespace

Result<Candidates> FindCandidates(const Terrain& terrain, const HullSweep& sweep, int threads,
                                  const RunControl& control) {
  constexpr std::size_t kRows = 32;
  constexpr double kSurvivors = 0.15;  // their share of the stage's time
  control.Report(Stage::kCandidates, 0);
  const CandidateSearch search(terrain, sweep);
  const auto rows = static_cast<std::size_t>(terrain.dem().rows);
  std::vector<std::vector<std::vector<Survivor>>> bands((rows + kRows - 1) / kRows);
  const auto find_survivors = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    bands[begin / kRows] =
        search.SurvivorsOf(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end));
  };
  std::vector<Candidates> by_checkpoint(sweep.checkpoints.size());
  const auto find_candidates = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<Survivor> survivors;
      for (const auto& band : bands) {
        survivors.insert(survivors.end(), band[i].begin(), band[i].end());
      }
      by_checkpoint[i] = search.CandidatesOf(i, survivors);
    }
  };
  if (!ParallelForBatches(rows, kRows, threads, Stage::kCandidates, control.Between(0, kSurvivors),
                          find_survivors) ||
      !ParallelForBatches(by_checkpoint.size(), 1, threads, Stage::kCandidates,
                          control.Between(kSurvivors, 1), find_candidates)) {
    return Error{ErrorCode::kCancelled, "stopped while looking for candidates"};
  }
  return Joined(by_checkpoint);
}

}  // namespace farhorizon
