// The lines of sight of one edge, exactly, as cells of a strip: t runs along the edge, directions turn
// from the edge's own to its opposite. Two curves that bound what obstacles hide cross at roots of a
// quadratic, their cross product: between neighbouring roots one order of the curves holds, which a point
// between them tells. [Archambault05] calls the cells' sides bitangents.
// Floating point only leaves out obstacles whose shade lies beside every cell by more than its error.
#include "core/horizon/lines_of_sight/visible_region.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/geometry/direction.h"
#include "core/horizon/lines_of_sight/occluded_cells.h"

namespace farhorizon {

namespace {

// A side of the wedge as a curve: in lowest terms, as those of neighbours that share a face are.
BoundaryCurve SideOf(const ShortVector& v) {
  const std::int64_t divisor = std::gcd(v.x, v.y);
  return {BoundaryCurve::Kind::kMoving, {v.x / divisor, v.y / divisor, 0, 0}};
}

}  // namespace

VisibleRegion::VisibleRegion(const TargetSegment& edge, const std::optional<FaceWedge>& wedge)
    : edge_(edge), bounds_(edge) {
  const ShortVector along{std::int64_t{edge.high.x} - edge.low.x,
                          std::int64_t{edge.high.y} - edge.low.y};
  StripCell all;
  all.first = BoundaryCurve::Along();
  all.last = BoundaryCurve::Against();
  if (wedge && CrossSign(along, wedge->first) != 0) all.first = SideOf(wedge->first);
  if (wedge && CrossSign(along, wedge->last) != 0) all.last = SideOf(wedge->last);
  Add(all);
}

template <std::size_t N>
bool VisibleRegion::MayMeet(const std::array<StripFilter::Corner, N>& corners, double top) const {
  const StripFilter::Shade shade = bounds_.ShadeOf(corners);
  const double reach = bounds_.Reach(top);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const StripFilter::Cell& cell = cell_bounds_[i];
    if (cell.from_t < reach && shade.Meets(cell) &&
        !bounds_.IsBeside(corners, cells_[i], cell.from_t, std::min(cell.to_t, reach))) {
      return true;
    }
  }
  return false;
}

std::optional<std::vector<StripCell>> VisibleRegion::Rest(const StripCell& cell,
                                                          const StripCell& hidden) {
  const IsolatedRoot& from = Compare(cell.from, hidden.from) < 0 ? hidden.from : cell.from;
  const IsolatedRoot& to = Compare(cell.to, hidden.to) > 0 ? hidden.to : cell.to;
  if (Compare(from, to) >= 0 || SurelyInOrder(cell.last, hidden.first, from.lo, to.hi) ||
      SurelyInOrder(hidden.last, cell.first, from.lo, to.hi)) {
    return std::nullopt;
  }
  std::vector<IsolatedRoot> roots;
  for (const BoundaryCurve& side : {hidden.first, hidden.last}) {
    AppendCrossings(side, cell.first, from.lo, to.hi, roots);
    AppendCrossings(side, cell.last, from.lo, to.hi, roots);
  }
  const std::vector<IsolatedRoot> cuts = Cuts(from, std::move(roots), to);
  bool changed = false;
  std::vector<StripCell> rest;
  StripBuilder strip(rest);
  if (Compare(cell.from, from) < 0) strip.Add(cell.from, from, {{cell.first, cell.last}});
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const SamplePoint point = PointBetween(cuts[i], cuts[i + 1]);
    std::vector<std::pair<BoundaryCurve, BoundaryCurve>> gaps;
    if (Order(hidden.first, cell.last, point) <= 0 || Order(cell.first, hidden.last, point) <= 0) {
      gaps.emplace_back(cell.first, cell.last);
    } else {
      changed = true;
      if (Order(cell.first, hidden.first, point) > 0) gaps.emplace_back(cell.first, hidden.first);
      if (Order(hidden.last, cell.last, point) > 0) gaps.emplace_back(hidden.last, cell.last);
    }
    strip.Add(cuts[i], cuts[i + 1], gaps);
  }
  if (!changed) return std::nullopt;
  if (Compare(to, cell.to) < 0) strip.Add(to, cell.to, {{cell.first, cell.last}});
  return rest;
}

void VisibleRegion::Subtract(const StripCell& hidden) {
  const StripFilter::Cell shade = bounds_.Of(hidden);
  std::vector<StripCell> made;
  for (std::size_t i = 0; i < cells_.size();) {
    if (cell_bounds_[i].from_slope < shade.to_slope &&
        cell_bounds_[i].to_slope > shade.from_slope) {
      if (std::optional<std::vector<StripCell>> rest = Rest(cells_[i], hidden)) {
        made.insert(made.end(), rest->begin(), rest->end());
        Remove(i);
        continue;
      }
    }
    ++i;
  }
  for (const StripCell& cell : made) Add(cell);
}

void VisibleRegion::Remove(std::size_t i) {
  cells_[i] = cells_.back();
  cell_bounds_[i] = cell_bounds_.back();
  cells_.pop_back();
  cell_bounds_.pop_back();
}

// Joined with those that it goes on in.
void VisibleRegion::Add(StripCell cell) {
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
  cell_bounds_.push_back(bounds_.Of(cell));
  cells_.push_back(cell);
}

void VisibleRegion::Subtract(const SegmentIndex::Item& item) {
  if (item.high.z <= edge_.low.z) return;
  const std::array<StripFilter::Corner, 2> ends = {bounds_.CornerAt(item.low.x, item.low.y),
                                                   bounds_.CornerAt(item.high.x, item.high.y)};
  if (!MayMeet(ends, item.high.z)) return;
  for (const StripCell& hidden : CellsOccludedBy(item, edge_)) Subtract(hidden);
}

void VisibleRegion::Subtract(const SegmentIndex& index, std::int32_t except) {
  const auto may_meet = [this](const SegmentIndex::Node& node) {
    const std::array<StripFilter::Corner, 4> box = {
        bounds_.CornerAt(node.min_x, node.min_y), bounds_.CornerAt(node.max_x, node.min_y),
        bounds_.CornerAt(node.max_x, node.max_y), bounds_.CornerAt(node.min_x, node.max_y)};
    return MayMeet(box, node.top);
  };
  const auto subtract = [this, except](std::int32_t id, const SegmentIndex::Item& item) {
    if (id != except) Subtract(item);
    return true;
  };
  index.VisitNearFirst(0.5 * (edge_.low.x + static_cast<double>(edge_.high.x)),
                       0.5 * (edge_.low.y + static_cast<double>(edge_.high.y)),
                       std::int64_t{edge_.low.z} + 1, may_meet, subtract);
}

}  // namespace farhorizon
