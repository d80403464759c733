// The edges that can be horizon edges, after three culls. The first two need the edge and the merge
// tree only. The third one compares each survivor of these with the hulls of the ground at or above
// some height, its *place* in the sweep: that of the upper end of a sloped edge, because ground at
// that height occludes the rest of the edge; one quantum more for a horizontal edge, which only
// ground strictly above occludes. Survivors go to the last state of the sweep's history before
// their place, from which its changes are replayed.
#include "core/horizon/sweep/candidates.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "core/base/parallel_for.h"
#include "core/horizon/budgeted_work.h"
#include "core/horizon/sweep/edge_occlusion.h"
#include "core/horizon/sweep/hull_history.h"

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

// An edge that the first two culls leave, and the least height of the ground whose hulls the third
// one compares it with.
struct Survivor {
  std::int32_t place;
  VertexId high;  // the upper end
  VertexId low;

  friend bool operator<(const Survivor& a, const Survivor& b) {
    return std::tie(b.place, a.high, a.low) < std::tie(a.place, b.high, b.low);
  }
};

class CandidateSearch {
 public:
  CandidateSearch(const Terrain& terrain, const HullSweep& sweep)
      : terrain_(terrain), sweep_(sweep), columns_(terrain.dem().columns) {}

  // The survivors among the edges from posts of these rows to later posts, by the states of the
  // history from which they are reached.
  [[nodiscard]] std::vector<std::vector<Survivor>> SurvivorsOf(std::int32_t first_row,
                                                               std::int32_t end_row) const {
    std::vector<std::vector<Survivor>> survivors(sweep_.history.state_count());
    for (VertexId v = first_row * columns_; v < end_row * columns_; ++v) {
      for (const VertexId n : terrain_.NeighboursOf(v)) {
        if (n < v) continue;
        const Edge edge{v, n};
        if (InsideHull(terrain_, sweep_.hulls, edge) || !IsRidge(terrain_, edge)) continue;
        const VertexId high = Height(n) > Height(v) ? n : v;
        const std::int32_t place = Height(v) == Height(n) ? Height(v) + 1 : Height(high);
        survivors[StateBefore(place)].push_back({place, high, high == v ? n : v});
      }
    }
    return survivors;
  }

  // Those of some survivors of the state that the third cull leaves. Requires: they are in order.
  // Each may take `limit` decisions; spent: receives those of all.
  [[nodiscard]] Candidates CandidatesOf(std::size_t state, std::span<const Survivor> survivors,
                                        std::int64_t limit, std::int64_t& spent) const {
    Candidates found;
    HullHistory::Replay replay(sweep_.history, state);
    std::vector<std::int32_t> likely;
    for (const Survivor& survivor : survivors) {
      replay.ApplyWhile([&](VertexId v) { return Height(v) >= survivor.place; });
      spent += AddUnlessOccluded(survivor, replay.scene(), limit, likely, found);
    }
    return found;
  }

 private:
  [[nodiscard]] std::int32_t Height(VertexId v) const {
    return terrain_.dem().heights[static_cast<std::size_t>(v)];
  }

  // The last state, or the first one, before which the plane has passed no ground below `place`.
  [[nodiscard]] std::size_t StateBefore(std::int32_t place) const {
    std::size_t low = 0;
    std::size_t high = sweep_.history.state_count();
    while (high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      (Height(sweep_.history.VertexAt(middle)) >= place ? low : high) = middle;
    }
    return low;
  }

  // Returns the decisions that it takes, `limit` or a few more at most.
  std::int64_t AddUnlessOccluded(const Survivor& survivor, const HullScene& scene,
                                 std::int64_t limit, std::vector<std::int32_t>& likely,
                                 Candidates& found) const {
    const Edge edge = MakeEdge(survivor.high, survivor.low);
    const Point3i high = terrain_.Point(survivor.high);
    const Point3i low = terrain_.Point(survivor.low);
    EdgeOcclusion occlusion({low.x, low.y}, {high.x, high.y}, WedgeOf(terrain_, edge));
    const std::int64_t spent = AddHulls(scene, {high.x, high.y}, limit, likely, occlusion);
    if (occlusion.IsOccluded()) return spent;
    const std::size_t first = found.virtual_occluders.size();
    occlusion.AppendVirtualOccluders(survivor.place, found.virtual_occluders);
    found.edges.push_back({edge, first, found.virtual_occluders.size() - first});
    return spent;
  }

  // Adds hulls until all directions are occluded, those that occlude most first: the hull around
  // the upper end, those that occluded the edge before, which is near as a rule, then large and
  // near ones. Returns the decisions that it takes.
  // likely: slots, any; receives those of the hulls that occlude this edge.
  static std::int64_t AddHulls(const HullScene& scene, Point2i high, std::int64_t limit,
                               std::vector<std::int32_t>& likely, EdgeOcclusion& occlusion) {
    // A look at a box or a cell takes about as long as a decision, a hull as four.
    constexpr std::int64_t kPerHull = 4;
    std::int64_t spent = 0;
    std::vector<std::int32_t> occluding;
    const auto add = [&](std::int32_t slot) {
      spent += kPerHull;
      if (occlusion.Add(scene.hull(slot))) occluding.push_back(slot);
    };
    const HullIndex& index = scene.index();
    const std::int32_t own =
        index.Find(high, high, [&](std::int32_t slot) { return scene.hull(slot).Contains(high); });
    if (own >= 0) add(own);
    for (const std::int32_t slot : likely) {
      if (slot == own || slot >= std::ssize(scene.hulls()) || occlusion.IsOccluded()) continue;
      const ConvexPolygon& hull = scene.hull(slot);
      if (occlusion.MayOcclude(hull.least(), hull.most())) add(slot);
    }
    if (!occlusion.IsOccluded()) {
      index.VisitNearFirst(
          high,
          [&](Point2i least, Point2i most) {
            return ++spent < limit && occlusion.MayOcclude(least, most);
          },
          [&](std::int32_t slot, Point2i least, Point2i most) {
            ++spent;
            if (slot != own && least != most && occlusion.MayOcclude(least, most)) add(slot);
            return spent < limit && !occlusion.IsOccluded();
          });
    }
    if (occlusion.IsOccluded()) likely = std::move(occluding);
    return spent;
  }

  const Terrain& terrain_;
  const HullSweep& sweep_;
  std::int32_t columns_;
};

// All candidates, by rising edge.
Candidates Joined(const std::vector<Candidates>& parts) {
  Candidates all;
  std::size_t edges = 0;
  std::size_t virtual_occluders = 0;
  for (const Candidates& some : parts) {
    edges += some.edges.size();
    virtual_occluders += some.virtual_occluders.size();
  }
  all.edges.reserve(edges);
  all.virtual_occluders.reserve(virtual_occluders);
  for (const Candidates& some : parts) {
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

std::vector<std::vector<Survivor>> SortedByState(
    std::vector<std::vector<std::vector<Survivor>>> bands, const HullSweep& sweep) {
  std::vector<std::vector<Survivor>> all(sweep.history.state_count());
  for (std::vector<std::vector<Survivor>>& band : bands) {
    for (std::size_t state = 0; state < band.size(); ++state) {
      all[state].insert(all[state].end(), band[state].begin(), band[state].end());
    }
    band = {};
  }
  for (std::vector<Survivor>& survivors : all) std::sort(survivors.begin(), survivors.end());
  return all;
}

}  // namespace

Result<Candidates> FindCandidates(const Terrain& terrain, const HullSweep& sweep, int threads,
                                  WorkBudget& budget, const RunControl& control) {
  constexpr std::size_t kRows = 32;
  constexpr std::size_t kTask = 1 << 15;
  // Of one survivor. Any value is sound: where it ends the search, the edge stays a candidate, for
  // the exact decision to deal with. On real DEMs it ends hardly any.
  constexpr std::int64_t kMostDecisions = 2048;
  // Of what is left of a budget that is short, one part in so many is for candidates.
  constexpr std::int64_t kShare = 8;
  const Error stopped{ErrorCode::kCancelled, "stopped while looking for candidates"};
  // Shares of the stage at which steps end; the last one is for what is begun anew.
  constexpr double kSurvivors = 0.15;
  constexpr double kFirstTime = 0.9;
  control.Report(Stage::kCandidates, 0);
  const CandidateSearch search(terrain, sweep);
  const auto rows = static_cast<std::size_t>(terrain.dem().rows);
  std::vector<std::vector<std::vector<Survivor>>> bands((rows + kRows - 1) / kRows);
  const auto find_survivors = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    bands[begin / kRows] =
        search.SurvivorsOf(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end));
  };
  if (!ParallelForBatches(rows, kRows, threads, Stage::kCandidates, control.Between(0, kSurvivors),
                          find_survivors)) {
    return stopped;
  }
  const std::vector<std::vector<Survivor>> survivors = SortedByState(std::move(bands), sweep);
  // The survivors of a state are divided where they are many: level ground has all in one place.
  struct Task {
    std::size_t state;
    std::span<const Survivor> survivors;
  };
  std::vector<Task> tasks;
  std::int64_t count = 0;
  for (std::size_t state = 0; state < survivors.size(); ++state) {
    const std::span<const Survivor> all(survivors[state]);
    count += std::ssize(all);
    for (std::size_t i = 0; i < all.size(); i += kTask) {
      tasks.push_back({state, all.subspan(i, std::min(kTask, all.size() - i))});
    }
  }
  std::vector<Candidates> parts(tasks.size());
  // Each survivor may take `limit` decisions. ends: where the budget is exceeded.
  const auto find_candidates = [&](std::int64_t limit, bool ends, const RunControl& part) {
    const auto find = [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
      for (std::size_t i = begin; i < end; ++i) {
        if (ends && budget.IsExceeded()) return;
        std::int64_t spent = 0;
        parts[i] = search.CandidatesOf(tasks[i].state, tasks[i].survivors, limit, spent);
        budget.Spend(spent);
      }
    };
    return ParallelForBatches(tasks.size(), 1, threads, Stage::kCandidates, part, find);
  };
  const std::int64_t before = budget.spent();
  if (!find_candidates(kMostDecisions, true, control.Between(kSurvivors, kFirstTime))) {
    return stopped;
  }
  if (budget.IsExceeded()) {
    if (!budget.approximate()) return OverBudget("looking for candidates", budget);
    budget.Rewind(before);
    const std::int64_t each = budget.left() / kShare / std::max<std::int64_t>(count, 1);
    if (!find_candidates(each, false, control.Between(kFirstTime, 1))) return stopped;
  }
  control.Report(Stage::kCandidates, 1);
  return Joined(parts);
}

}  // namespace farhorizon
