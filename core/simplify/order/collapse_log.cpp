// A collapse can be taken back where all triangles that it changed or took are as it left them. So
// the later collapses that changed one of them are taken back first, and so on: they form a
// directed graph without cycles, as time goes one way, which is walked with a stack of its own.
#include "core/simplify/order/collapse_log.h"

#include <utility>

namespace farhorizon {

void CollapseLog::Begin(const HalfEdgeMesh& mesh) {
  End();
  last_.resize(mesh.half_edges() / 3, kNone);
}

void CollapseLog::Record(const Ring& ring, std::int32_t j) {
  const auto now = static_cast<std::int32_t>(collapses_.size());
  // Of the triangles beside the spoke to j one exists, also at a rim.
  const std::int32_t gone = ring.triangle_at(j < ring.sides() ? j : j - 1);
  collapses_.push_back({ring.centre, ring.id(j), gone, static_cast<std::int32_t>(sides_.size())});
  for (std::int32_t i = 0; i < ring.sides(); ++i) {
    std::int32_t& last = last_[ring.triangle_at(i)];
    sides_.push_back({ring.triangle_at(i), std::exchange(last, now)});
  }
}

std::size_t CollapseLog::EndOfSides(std::int32_t collapse) const {
  const auto next = static_cast<std::size_t>(collapse) + 1;
  return next < collapses_.size() ? static_cast<std::size_t>(collapses_[next].side) : sides_.size();
}

std::int32_t CollapseLog::LaterThan(std::int32_t collapse) const {
  const std::size_t end = EndOfSides(collapse);
  for (auto i = static_cast<std::size_t>(collapses_[static_cast<std::size_t>(collapse)].side);
       i < end; ++i) {
    if (last_[sides_[i].triangle] != collapse) return last_[sides_[i].triangle];
  }
  return kNone;
}

void CollapseLog::TakeBack(HalfEdgeMesh& mesh, std::int32_t collapse,
                           std::vector<std::pair<std::int32_t, std::int32_t>>& back) {
  std::vector<std::int32_t> waiting = {collapse};
  while (!waiting.empty()) {
    const std::int32_t now = waiting.back();
    const std::int32_t later = LaterThan(now);
    if (later != kNone) {
      waiting.push_back(later);
      continue;
    }
    waiting.pop_back();
    Collapse& it = collapses_[static_cast<std::size_t>(now)];
    mesh.TakeBack(it.vertex, it.onto, it.gone);
    const std::size_t end = EndOfSides(now);
    for (auto i = static_cast<std::size_t>(it.side); i < end; ++i) {
      last_[sides_[i].triangle] = sides_[i].before;
    }
    back.emplace_back(it.vertex, it.onto);
    it.vertex = kNone;
  }
}

}  // namespace farhorizon
