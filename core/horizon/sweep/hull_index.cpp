#include "core/horizon/sweep/hull_index.h"

namespace farhorizon {

HullIndex::HullIndex(std::int32_t columns, std::int32_t rows)
    : columns_((columns - 1) / kCell + 1),
      rows_((rows - 1) / kCell + 1),
      heads_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, kNone) {}

void HullIndex::Add(const ConvexPolygon& hull) {
  entries_.push_back({hull.least(), hull.most()});
  Link(static_cast<std::int32_t>(entries_.size()) - 1);
}

void HullIndex::Grow(std::int32_t slot, const ConvexPolygon& hull) {
  Entry& entry = At(slot);
  entry.least = hull.least();
  entry.most = hull.most();
  if (ListOf(entry) == entry.list) return;
  Unlink(slot);
  Link(slot);
}

void HullIndex::Drop(std::int32_t slot) {
  Unlink(slot);
  const auto last = static_cast<std::int32_t>(entries_.size()) - 1;
  if (slot != last) {
    At(slot) = At(last);
    Relink(slot);
  }
  entries_.pop_back();
}

std::size_t HullIndex::ListOf(const Entry& entry) const {
  const bool small = entry.most.x - entry.least.x <= kCell && entry.most.y - entry.least.y <= kCell;
  return small ? CellAt(entry.least.x / kCell, entry.least.y / kCell) : heads_.size() - 1;
}

void HullIndex::Link(std::int32_t slot) {
  Entry& entry = At(slot);
  entry.list = ListOf(entry);
  entry.previous = kNone;
  entry.next = heads_[entry.list];
  Relink(slot);
}

void HullIndex::Unlink(std::int32_t slot) {
  const Entry& entry = At(slot);
  (entry.previous == kNone ? heads_[entry.list] : At(entry.previous).next) = entry.next;
  if (entry.next != kNone) At(entry.next).previous = entry.previous;
}

void HullIndex::Relink(std::int32_t slot) {
  const Entry& entry = At(slot);
  (entry.previous == kNone ? heads_[entry.list] : At(entry.previous).next) = slot;
  if (entry.next != kNone) At(entry.next).previous = slot;
}

}  // namespace farhorizon
