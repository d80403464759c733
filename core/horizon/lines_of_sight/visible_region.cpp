// The lines of sight of one edge, exactly, as cells of its strip (strip_cell.h). Each occluder has
// cells that it occludes (occluded_cells.h), which are subtracted. The difference of two cells is
// found slab by slab: between neighbouring t at which a curve of one crosses a curve of the other,
// one order of the four curves holds, which one sample tells. Where t is fixed, a cell's sides are
// the bitangents of [Archambault03, section 3.1].
//
//      cell.last  +------+-----------------+------+
//                 |      |     remains     |      |
//                 |      |    ___---___    |      |   occluded.last
//                 | cell | .-'         '-. | cell |
//                 |      |'   occluded    '|      |
//      cell.first +------+-----------------+------+
//                       /:                 :|         slabs end where curves cross
//
// Cost: floating point skips occluders that surely miss every cell (strip_filter.h); each of the
// others costs a few quadratics for each cell that it may overlap.
#include "core/horizon/lines_of_sight/visible_region.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/geometry/direction.h"
#include "core/horizon/lines_of_sight/occluded_cells.h"

namespace farhorizon {

namespace {

// In decisions (work_budget.h), about: finding what an occluder takes, or what is left of a cell,
// are some quadratics, their roots and an exact sample for each.
constexpr std::int64_t kExactStep = 50;

// A side of the wedge as a curve: in lowest terms, so that it is equal to CurveOf's for an edge of
// the same face (occluded_cells.cpp).
BoundaryCurve SideOf(const ShortVector& v) {
  const std::int64_t divisor = std::gcd(v.x, v.y);
  return {BoundaryCurve::Kind::kMoving, {v.x / divisor, v.y / divisor, 0, 0}};
}

}  // namespace

VisibleRegion::VisibleRegion(const TargetSegment& edge, const std::optional<FaceWedge>& wedge)
    : edge_(edge), filter_(edge) {
  const ShortVector along{std::int64_t{edge.high.x} - edge.low.x,
                          std::int64_t{edge.high.y} - edge.low.y};
  StripCell all;
  all.first = BoundaryCurve::Along();
  all.last = BoundaryCurve::Against();
  if (wedge && CrossSign(along, wedge->first) != 0) all.first = SideOf(wedge->first);
  if (wedge && CrossSign(along, wedge->last) != 0) all.last = SideOf(wedge->last);
  Insert(all);
}

template <std::size_t N>
bool VisibleRegion::MayOcclude(const std::array<StripFilter::Corner, N>& corners,
                               double top) const {
  const StripFilter::OccludedSlopes slopes = filter_.OccludedSlopesOf(corners);
  const double last_t = filter_.LastTBelow(top);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const StripFilter::CellBounds& cell = bounds_[i];
    if (cell.from_t < last_t && slopes.Overlap(cell) &&
        !filter_.SurelyDisjoint(corners, cells_[i], cell.from_t, std::min(cell.to_t, last_t))) {
      return true;
    }
  }
  return false;
}

std::optional<std::vector<StripCell>> VisibleRegion::Difference(const StripCell& cell,
                                                                const StripCell& occluded) {
  const IsolatedRoot& from = Compare(cell.from, occluded.from) < 0 ? occluded.from : cell.from;
  const IsolatedRoot& to = Compare(cell.to, occluded.to) > 0 ? occluded.to : cell.to;
  if (Compare(from, to) >= 0 || SurelyInOrder(cell.last, occluded.first, from.lo, to.hi) ||
      SurelyInOrder(occluded.last, cell.first, from.lo, to.hi)) {
    return std::nullopt;
  }
  std::vector<IsolatedRoot> roots;
  roots.reserve(4);
  for (const BoundaryCurve& side : {occluded.first, occluded.last}) {
    AppendCrossings(side, cell.first, from.lo, to.hi, roots);
    AppendCrossings(side, cell.last, from.lo, to.hi, roots);
  }
  const std::vector<IsolatedRoot> cuts = Cuts(from, std::move(roots), to);
  bool changed = false;
  std::vector<StripCell> difference;
  StripBuilder strip(difference);
  if (Compare(cell.from, from) < 0) strip.AddSlab(cell.from, from, {cell.first, cell.last});
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const SamplePoint point = PointBetween(cuts[i], cuts[i + 1]);
    CurvePairs remaining;
    if (Order(occluded.first, cell.last, point) <= 0 ||
        Order(cell.first, occluded.last, point) <= 0) {
      remaining.Add(cell.first, cell.last);
    } else {
      changed = true;
      if (Order(cell.first, occluded.first, point) > 0) remaining.Add(cell.first, occluded.first);
      if (Order(occluded.last, cell.last, point) > 0) remaining.Add(occluded.last, cell.last);
    }
    strip.AddSlab(cuts[i], cuts[i + 1], remaining);
  }
  if (!changed) return std::nullopt;
  if (Compare(to, cell.to) < 0) strip.AddSlab(to, cell.to, {cell.first, cell.last});
  return difference;
}

void VisibleRegion::Subtract(const StripCell& occluded) {
  const StripFilter::CellBounds bounds = filter_.BoundsOf(occluded);
  std::vector<StripCell> replacements;
  for (std::size_t i = 0; i < cells_.size();) {
    if (bounds_[i].from_slope < bounds.to_slope && bounds_[i].to_slope > bounds.from_slope) {
      work_ += kExactStep;
      if (const std::optional<std::vector<StripCell>> remaining = Difference(cells_[i], occluded)) {
        replacements.insert(replacements.end(), remaining->begin(), remaining->end());
        Remove(i);
        continue;
      }
    }
    ++i;
  }
  for (const StripCell& cell : replacements) Insert(cell);
}

void VisibleRegion::Remove(std::size_t i) {
  cells_[i] = cells_.back();
  bounds_[i] = bounds_.back();
  cells_.pop_back();
  bounds_.pop_back();
}

// Joined with the cells that it continues: those between the same curves that end where it begins,
// or begin where it ends.
void VisibleRegion::Insert(StripCell cell) {
  for (std::size_t i = 0; i < cells_.size();) {
    const StripCell& other = cells_[i];
    const bool same = cell.first == other.first && cell.last == other.last;
    if (same && Compare(other.to, cell.from) == 0) {
      cell.from = other.from;
    } else if (same && Compare(cell.to, other.from) == 0) {
      cell.to = other.to;
    } else {
      ++i;
      continue;
    }
    Remove(i);
  }
  bounds_.push_back(filter_.BoundsOf(cell));
  cells_.push_back(cell);
}

void VisibleRegion::AddOccluder(const SegmentIndex::Item& item) {
  if (item.high.z <= edge_.low.z || work_ >= work_limit_) return;
  work_ += std::ssize(cells_);
  const std::array<StripFilter::Corner, 2> ends = {filter_.CornerAt(item.low.x, item.low.y),
                                                   filter_.CornerAt(item.high.x, item.high.y)};
  if (!MayOcclude(ends, item.high.z)) return;
  work_ += kExactStep;
  for (const StripCell& occluded : CellsOccludedBy(item, edge_)) Subtract(occluded);
}

void VisibleRegion::AddOccluders(const SegmentIndex& index, std::int32_t except) {
  const auto may_occlude = [this](const SegmentIndex::Node& node) {
    const std::array<StripFilter::Corner, 4> box = {
        filter_.CornerAt(node.min_x, node.min_y), filter_.CornerAt(node.max_x, node.min_y),
        filter_.CornerAt(node.max_x, node.max_y), filter_.CornerAt(node.min_x, node.max_y)};
    work_ += std::ssize(cells_);
    return MayOcclude(box, node.top);
  };
  const auto add = [this, except](std::int32_t id, const SegmentIndex::Item& item) {
    if (id != except) AddOccluder(item);
    return work_ < work_limit_;
  };
  index.VisitNearFirst(0.5 * (edge_.low.x + static_cast<double>(edge_.high.x)),
                       0.5 * (edge_.low.y + static_cast<double>(edge_.high.y)),
                       std::int64_t{edge_.low.z} + 1, may_occlude, add);
}

}  // namespace farhorizon
