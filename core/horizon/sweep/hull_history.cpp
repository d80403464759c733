#include "core/horizon/sweep/hull_history.h"

#include <algorithm>

namespace farhorizon {

void HullHistory::Append(VertexId by, const HullChange& change) {
  const bool after_state = !states_.empty() && states_.back().next_record == records_.size();
  if (change.kind == HullChange::Kind::kExtension && !records_.empty() && !after_state) {
    Record& last = records_.back();
    if (last.kind == change.kind && last.hull == change.hull && last.by + last.other + 1 == by) {
      ++last.other;
      return;
    }
  }
  records_.push_back(
      {change.kind, by, change.hull, change.kind == HullChange::Kind::kMerge ? change.other : 0});
}

void HullHistory::OfferState(VertexId next, const HullScene& scene) {
  constexpr std::size_t kBytesPerPost = 8;
  constexpr std::size_t kLeastBytes = 1 << 20;
  const std::size_t most_bytes =
      std::max(kLeastBytes, kBytesPerPost * static_cast<std::size_t>(columns_) *
                                static_cast<std::size_t>(rows_));
  if (offered_++ % stride_ != 0) return;
  states_.push_back({next, records_.size(), scene.Snapshot()});
  state_bytes_ += states_.back().hulls.bytes();
  while (state_bytes_ > most_bytes && states_.size() > 1) {
    std::size_t kept = 0;
    state_bytes_ = 0;
    for (std::size_t i = 0; i < states_.size(); i += 2) {
      if (i != kept) states_[kept] = std::move(states_[i]);
      state_bytes_ += states_[kept++].hulls.bytes();
    }
    states_.resize(kept);
    stride_ *= 2;
  }
}

HullHistory::Replay::Replay(const HullHistory& history, std::size_t state)
    : history_(history),
      scene_(history.columns_, history.rows_, history.states_[state].hulls),
      next_(history.states_[state].next_record) {}

void HullHistory::Replay::ApplyNext() {
  const Record& record = history_.records_[next_];
  const VertexId vertex = record.by + repeated_;
  const Point2i post{vertex % history_.columns_, vertex / history_.columns_};
  const bool extension = record.kind == HullChange::Kind::kExtension;
  scene_.Apply({record.kind, record.hull, extension ? 0 : record.other, post});
  if (extension && repeated_ < record.other) {
    ++repeated_;
    return;
  }
  ++next_;
  repeated_ = 0;
}

}  // namespace farhorizon
