// Most edges that collapses make are gone again when the level is done: at 1201 x 1201 posts four
// of five of those that only a search of the guard could decide. So they are made unasked, and what
// is left is asked at the end, by all threads. A few in a hundred rise, nearly all of them beside a
// horizon edge's end. An edge that rises goes with the last collapse that changed a triangle beside
// it; the edges that stand again then are asked, in turn. That ends, as each collapse is taken back
// once, and what stood when the log began does not rise.
#include "core/simplify/order/take_back_rises.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/parallel_for.h"

namespace farhorizon {

namespace {

constexpr std::int32_t kNone = HalfEdgeMesh::kNone;

class RiseRemover {
 public:
  RiseRemover(Workpiece& work, CollapseLog& log) : work_(work), mesh_(work.mesh), log_(log) {}

  bool FindRisen(int threads, const RunControl& control) {
    std::vector<std::int32_t> made;
    for (std::int32_t h = 0; h < mesh_.half_edges(); ++h) {
      if (mesh_.Stands(h / 3) && mesh_.twin(h) < h && IsMade(h)) made.push_back(h);
    }
    std::vector<std::uint8_t> rises(made.size(), 0);
    // Without stages of its own: it is the end of the collapses.
    RunControl quiet = control;
    quiet.progress = nullptr;
    const bool done = ParallelForBatches(
        made.size(), kBatch, threads, Stage::kSimplify, quiet,
        [&](std::size_t begin, std::size_t end, std::size_t) {
          std::vector<OccluderId> likely;
          for (std::size_t i = begin; i < end; ++i) {
            const std::int32_t h = made[i];
            rises[i] = work_.rules.Rises(mesh_.at(mesh_.origin(h)),
                                         mesh_.at(mesh_.origin(HalfEdgeMesh::Next(h))), likely);
          }
        });
    for (std::size_t i = 0; i < made.size(); ++i) {
      if (rises[i] != 0) open_.push_back(EdgeOf(made[i]));
    }
    std::reverse(open_.begin(), open_.end());
    known_ = open_.size();
    return done;
  }

  bool Remove(const RunControl& control) {
    std::int32_t turn = 0;
    while (!open_.empty()) {
      if (++turn % kVerticesBetweenChecks == 0 && control.StopRequested()) return false;
      // What lies below known_ is known to rise.
      const auto [a, b] = open_.back();
      const std::int32_t h = Find(a, b);
      if (h == kNone || !IsMade(h) ||
          (open_.size() > known_ && !work_.rules.Rises(mesh_.at(a), mesh_.at(b), likely_))) {
        open_.pop_back();
        known_ = std::min(known_, open_.size());
        continue;
      }
      const std::int32_t twin = mesh_.twin(h);
      TakeBack(std::max(log_.LastAt(h / 3), twin == kNone ? kNone : log_.LastAt(twin / 3)));
    }
    return true;
  }

 private:
  using Pair = std::pair<std::int32_t, std::int32_t>;

  // A collapse has changed the triangles on both sides, or an edge of the beginning would stand.
  [[nodiscard]] bool IsMade(std::int32_t h) const {
    const std::int32_t twin = mesh_.twin(h);
    return log_.LastAt(h / 3) != kNone && (twin == kNone || log_.LastAt(twin / 3) != kNone);
  }
  [[nodiscard]] Pair EdgeOf(std::int32_t h) const {
    return {mesh_.origin(h), mesh_.origin(HalfEdgeMesh::Next(h))};
  }

  // A half-edge of the edge a, b; kNone where there is none.
  std::int32_t Find(std::int32_t a, std::int32_t b) {
    if (!mesh_.IsVertex(a) || !mesh_.IsVertex(b)) return kNone;
    const std::int32_t v = mesh_.IsKnotted(a) ? b : a;
    const std::int32_t w = v == a ? b : a;
    if (!mesh_.Gather(v, ring_)) return kNone;
    for (std::int32_t i = 0; i < ring_.sides(); ++i) {
      for (std::int32_t h = 3 * ring_.triangle_at(i); h < 3 * ring_.triangle_at(i) + 3; ++h) {
        const Pair edge = EdgeOf(h);
        if (edge == Pair{v, w} || edge == Pair{w, v}) return h;
      }
    }
    return kNone;
  }

  void TakeBack(std::int32_t collapse) {
    back_.clear();
    log_.TakeBack(mesh_, collapse, back_);
    for (const auto& [v, onto] : back_) Restore(v, onto);
  }

  void Restore(std::int32_t v, std::int32_t onto) {
    if (!mesh_.Gather(v, ring_)) return;
    for (std::int32_t i = 0; i < ring_.sides(); ++i) mesh_.Measure(ring_.triangle_at(i));
    std::int32_t j = 0;
    while (j + 1 < ring_.count && ring_.id(j) != onto) ++j;
    for (std::int32_t i = 0; i < ring_.count; ++i) {
      const std::int32_t u = ring_.id(i);
      if (!ring_.Joined(i, j) && mesh_.IsVertex(onto)) work_.skyline.Forget(onto, u);
      if (work_.price.MayRise(mesh_.at(v), ring_.at(i))) work_.skyline.Raise(v, u);
      work_.Touch(u, 0);
      open_.emplace_back(v, u);
    }
    work_.Touch(v, 0);
  }

  Workpiece& work_;
  HalfEdgeMesh& mesh_;
  CollapseLog& log_;
  std::vector<Pair> open_;  // edges that may rise, by their vertices
  std::size_t known_ = 0;
  std::vector<Pair> back_;
  std::vector<OccluderId> likely_;
  Ring ring_;
};

}  // namespace

Status TakeBackRises(Workpiece& work, CollapseLog& log, int threads, const RunControl& control) {
  RiseRemover remover(work, log);
  const bool done = remover.FindRisen(threads, control) && remover.Remove(control);
  log.End();
  if (!done) return Error{ErrorCode::kCancelled, "stopped while simplifying"};
  return Ok{};
}

}  // namespace farhorizon
