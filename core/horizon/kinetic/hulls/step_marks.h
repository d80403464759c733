#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace farhorizon::kinetic {

using PointId = std::int32_t;
using ClusterId = std::int32_t;

/// An id as an index. Requires: it is not negative.
constexpr std::size_t Index(std::int32_t id) { return static_cast<std::size_t>(id); }

/// What has changed in the present step of the scene and is to be put in order before the step
/// ends.
///
/// A point is *stale* if it is, or was, a corner at which the order, the activities and the
/// certificates of the tangents are to be found anew (CornerOrder::Rebuild). It is *displaced* if,
/// moreover, some of the tangents may no longer support its hull there (TangentMotion). Each list
/// has the points in the order in which they were marked, each once, and every displaced point is
/// stale until the step ends.
///
/// A hull is marked for a *recount* if its corners changed, or tangents moved among them: the
/// depths of its corners (OcclusionDepths) have no meaning until they are counted anew.
class StepMarks {
 public:
  void AddPoint() { points_.emplace_back(); }
  void AddCluster() { recounts_.push_back(false); }

  void MarkStale(PointId p) {
    if (std::exchange(points_[Index(p)].stale, true)) return;
    stale_.push_back(p);
  }
  void MarkDisplaced(PointId p) {
    MarkStale(p);
    if (std::exchange(points_[Index(p)].displaced, true)) return;
    displaced_.push_back(p);
  }
  [[nodiscard]] bool IsStale(PointId p) const { return points_[Index(p)].stale; }
  [[nodiscard]] bool IsDisplaced(PointId p) const { return points_[Index(p)].displaced; }
  [[nodiscard]] const std::vector<PointId>& stale() const { return stale_; }
  [[nodiscard]] const std::vector<PointId>& displaced() const { return displaced_; }
  void ClearStale() {
    for (const PointId p : stale_) points_[Index(p)].stale = false;
    stale_.clear();
  }
  void ClearDisplaced() {
    for (const PointId p : displaced_) points_[Index(p)].displaced = false;
    displaced_.clear();
  }

  void MarkForRecount(ClusterId c) { recounts_[Index(c)] = true; }
  [[nodiscard]] bool NeedsRecount(ClusterId c) const { return recounts_[Index(c)]; }
  /// Whether the hull was marked; it is no more.
  bool TakeRecount(ClusterId c) {
    const bool marked = recounts_[Index(c)];
    recounts_[Index(c)] = false;
    return marked;
  }

 private:
  struct Marks {
    bool stale = false;
    bool displaced = false;
  };
  std::vector<Marks> points_;
  std::vector<bool> recounts_;
  std::vector<PointId> stale_;
  std::vector<PointId> displaced_;
};

}  // namespace farhorizon::kinetic
