#include "core/horizon/sweep/hull_index.h"

namespace farhorizon {

HullIndex::HullIndex(std::int32_t columns, std::int32_t rows) {
  for (int bits = kSmallestCellBits; tiers_.empty() || tiers_.back().cells.size() > 1; ++bits) {
    const std::int32_t across = ((columns - 1) >> bits) + 1;
    const std::int32_t down = ((rows - 1) >> bits) + 1;
    tiers_.push_back(
        {across, down,
         std::vector<Cell>(static_cast<std::size_t>(across) * static_cast<std::size_t>(down))});
  }
}

void HullIndex::Add(const ConvexPolygon& hull) {
  entries_.push_back({hull.least(), hull.most()});
  Link(static_cast<std::int32_t>(entries_.size()) - 1);
}

void HullIndex::Grow(std::int32_t slot, const ConvexPolygon& hull) {
  Entry& entry = At(slot);
  const bool same = entry.least == hull.least() && entry.most == hull.most();
  if (same) return;
  entry.least = hull.least();
  entry.most = hull.most();
  if (HomeOf(entry) == entry.cell) return;
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

// The root is as wide and high as the DEM, so it holds every box.
HullIndex::CellId HullIndex::HomeOf(const Entry& entry) const {
  const std::int32_t size = std::max(entry.most.x - entry.least.x, entry.most.y - entry.least.y);
  std::int32_t tier = 0;
  while (size > (std::int32_t{1} << (tier + kSmallestCellBits))) ++tier;
  const int bits = tier + kSmallestCellBits;
  return {tier, entry.least.x >> bits, entry.least.y >> bits};
}

void HullIndex::Count(CellId home, std::int32_t change) {
  for (CellId cell = home;; cell = {cell.tier + 1, cell.x >> 1, cell.y >> 1}) {
    CellAt(cell).count += change;
    if (cell == Root()) return;
  }
}

void HullIndex::Link(std::int32_t slot) {
  Entry& entry = At(slot);
  entry.cell = HomeOf(entry);
  Count(entry.cell, 1);
  entry.previous = kNone;
  entry.next = CellAt(entry.cell).first;
  Relink(slot);
}

void HullIndex::Unlink(std::int32_t slot) {
  const Entry& entry = At(slot);
  Count(entry.cell, -1);
  (entry.previous == kNone ? CellAt(entry.cell).first : At(entry.previous).next) = entry.next;
  if (entry.next != kNone) At(entry.next).previous = entry.previous;
}

void HullIndex::Relink(std::int32_t slot) {
  const Entry& entry = At(slot);
  (entry.previous == kNone ? CellAt(entry.cell).first : At(entry.previous).next) = slot;
  if (entry.next != kNone) At(entry.next).previous = slot;
}

}  // namespace farhorizon
