#pragma once

#include <bitset>
#include <cstdint>
#include <utility>

#include "core/base/result.h"
#include "core/simplify/order/collapse_log.h"
#include "core/simplify/work/workpiece.h"

namespace farhorizon {

/// Collapses vertices onto neighbours, the cheapest first, down to a number of triangles.
class Collapser {
 public:
  /// Requires: `work` outlives it.
  explicit Collapser(Workpiece& work) : work_(&work), target_(work.mesh.vertices(), kNone) {}

  /// Rates vertex v and queues it.
  void Consider(std::int32_t v) { Consider(v, -1); }
  /// Collapses until no more than `budget` triangles are left, or nothing can be collapsed.
  /// reweigh() is called after each 30 % of the triangles, and progress reported.
  template <typename Reweigh>
  Status Run(std::int32_t budget, const RunControl& control, Reweigh reweigh);
  /// Collapses v at whatever price, if it can be collapsed at all.
  bool Force(std::int32_t v);
  /// Once it has begun, it has every collapse.
  CollapseLog& log() { return log_; }

 private:
  static constexpr std::int32_t kNone = -1;
  using Refused = std::bitset<Ring::kMost>;  // places in the ring

  bool Consider(std::int32_t v, std::int32_t bucket);
  std::pair<float, std::int32_t> Rate(std::int32_t v, const Refused& refused);
  [[nodiscard]] bool Fits(std::int32_t j) const;
  [[nodiscard]] float Cost(std::int32_t j, float before, float most, bool rises) const;
  [[nodiscard]] bool IsAllowed(std::int32_t j) const;
  [[nodiscard]] std::int32_t PlaceInRing(std::int32_t v) const;
  /// Rates v until its cheapest target is allowed. The ring is v's.
  std::pair<float, std::int32_t> RateAllowed(std::int32_t v);
  void Collapse(std::int32_t v);

  Workpiece* work_;
  Table<std::int32_t> target_;  // per vertex: the neighbour that it would go to
  std::vector<std::int32_t> now_;
  CollapseLog log_;
  Ring ring_;
};

template <typename Reweigh>
Status Collapser::Run(std::int32_t budget, const RunControl& control, Reweigh reweigh) {
  HalfEdgeMesh& mesh = work_->mesh;
  const auto next_weighing = [&] { return static_cast<std::int32_t>(mesh.triangles() * 0.7); };
  std::int32_t next = next_weighing();
  const std::int32_t first = mesh.triangles();
  std::int32_t turn = 0;
  while (mesh.triangles() > budget) {
    const std::int32_t bucket = work_->queue.Lowest();
    if (bucket < 0) break;
    work_->queue.Take(bucket, now_);
    std::size_t i = 0;
    for (; i < now_.size() && mesh.triangles() > budget; ++i) {
      if (++turn % kVerticesBetweenChecks == 0 && control.StopRequested()) {
        return Error{ErrorCode::kCancelled, "stopped while simplifying"};
      }
      const std::int32_t v = now_[i];
      work_->queued[static_cast<std::size_t>(v)] = false;
      if (!mesh.IsVertex(v) || work_->stays[static_cast<std::size_t>(v)]) continue;
      if (!Consider(v, bucket)) continue;
      Collapse(v);
      for (std::int32_t k = 0; k < ring_.count; ++k) work_->Touch(ring_.id(k), bucket);
      if (mesh.triangles() < next) {
        reweigh();
        next = next_weighing();
        control.Report(Stage::kSimplify,
                       static_cast<double>(first - mesh.triangles()) / (first - budget));
      }
    }
    for (; i < now_.size(); ++i) work_->queue.Add(now_[i], bucket);
  }
  return Ok{};
}

}  // namespace farhorizon
