#include "core/measure/occluded_lines.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

namespace farhorizon {

namespace {

using Offsets = std::array<double, LineBox::kCorners>;

// A box after so many halvings is less than 10^-12 of a cell or of half a turn wide each way: one
// line as far as doubles can tell, and its middle line stands for it.
constexpr int kMostHalvings = 80;

double Cross(const GridPoint& o, const GridPoint& p, const GridPoint& q) {
  return (p.column - o.column) * (q.row - o.row) - (p.row - o.row) * (q.column - o.column);
}

// The height of a segment where it crosses a line, by its ends' offsets from the line, which have
// not the same sign. A segment in the line: its lower end.
double HeightAtCrossing(const Occluder& o, double of_a, double of_b) {
  const double whole = of_a - of_b;
  if (whole == 0) return std::min(o.a.height_m, o.b.height_m);
  return o.a.height_m + (o.b.height_m - o.a.height_m) * (of_a / whole);
}

GridPoint Middle(const GridPoint& p, const GridPoint& q) {
  return {(p.column + q.column) / 2, (p.row + q.row) / 2, (p.height_m + q.height_m) / 2};
}

}  // namespace

NetHull NetHull::Of(const SkylineNet& net) {
  // The ends of segments, sorted, then the lower and the upper chain [Andrew79].
  std::vector<std::int32_t> used;
  for (const SkylineNet::Segment& s : net.segments) {
    used.push_back(s.a);
    used.push_back(s.b);
  }
  std::sort(used.begin(), used.end(), [&net](std::int32_t i, std::int32_t j) {
    const GridPoint& p = net.Point(i);
    const GridPoint& q = net.Point(j);
    return std::tie(p.column, p.row, i) < std::tie(q.column, q.row, j);
  });
  used.erase(std::unique(used.begin(), used.end()), used.end());
  NetHull hull;
  hull.place.assign(net.points.size(), kNoneThere);
  const auto add = [&](std::int32_t i, std::size_t base) {
    while (hull.ring.size() > base + 1 && Cross(net.Point(hull.ring[hull.ring.size() - 2]),
                                                net.Point(hull.ring.back()), net.Point(i)) <= 0) {
      hull.ring.pop_back();
    }
    hull.ring.push_back(i);
  };
  for (const std::int32_t i : used) add(i, 0);
  const std::size_t base = hull.ring.empty() ? 0 : hull.ring.size() - 1;
  for (std::size_t k = used.size(); k-- > 0;) {
    if (k + 1 < used.size()) add(used[k], base);
  }
  if (hull.ring.size() > 1) hull.ring.pop_back();
  for (const std::int32_t i : hull.ring) {
    const GridPoint& p = net.Point(i);
    const GridPoint& q = net.Point(hull.ring.front());
    hull.reach = std::max(hull.reach, std::hypot(p.column - q.column, p.row - q.row));
  }
  for (std::size_t k = 0; k < hull.ring.size(); ++k) {
    hull.place[static_cast<std::size_t>(hull.ring[k])] = static_cast<std::int32_t>(k);
  }
  return hull;
}

bool OccludedLines::MissesNet(const LineBox& box) const {
  bool left = true;
  bool right = true;
  for (const std::int32_t i : hull_->ring) {
    const Offsets of = box.Offsets(net_->Point(i).column, net_->Point(i).row);
    left = left && std::all_of(of.begin(), of.end(), [](double o) { return o < 0; });
    right = right && std::all_of(of.begin(), of.end(), [](double o) { return o > 0; });
    if (!left && !right) return false;
  }
  return true;
}

bool OccludedLines::MissesNet(const GridPoint& through, DirectionRange::Normal normal) const {
  return MissesNet(LineBox{through, through, {normal, normal}});
}

bool OccludedLines::ProvenAtJoint(const BoxQuestion& question,
                                  const std::vector<Occluder>& candidates, const LooseEnd& left,
                                  const LooseEnd& right) const {
  const Occluder& l = candidates[left.candidate];
  const Occluder& r = candidates[right.candidate];
  const LineBox& box = question.box;
  const GridPoint& joint = l.a_id == left.id ? l.a : l.b;
  const double most = std::max(box.from.height_m, box.to.height_m);
  if (joint.height_m < most - question.allowed_m) return false;
  const Offsets of_joint = box.Offsets(joint.column, joint.row);
  for (std::size_t c = 0; c < LineBox::kCorners; ++c) {
    // A line with the joint on its right crosses the segment whose other end is on its left.
    const Occluder& crossed = of_joint[c] > 0 ? l : r;
    const GridPoint& other = crossed.a_id == left.id ? crossed.b : crossed.a;
    const double of_other = box.Offsets(other.column, other.row)[c];
    const double height = HeightAtCrossing({joint, other}, of_joint[c], of_other);
    if (height < box.HeightAt(c) - question.allowed_m) return false;
  }
  return true;
}

bool OccludedLines::ProvenAtHull(const BoxQuestion& question,
                                 const std::vector<Occluder>& candidates,
                                 const LooseEnd& end) const {
  const std::int32_t place = hull_->place[static_cast<std::size_t>(end.id)];
  if (place == kNoneThere) return false;
  const Occluder& o = candidates[end.candidate];
  const LineBox& box = question.box;
  const GridPoint& corner = o.a_id == end.id ? o.a : o.b;
  const GridPoint& other = o.a_id == end.id ? o.b : o.a;
  // The corner has to be the net's outermost point on its side in all directions.
  const auto count = static_cast<std::int32_t>(hull_->ring.size());
  const double sign = end.other == Side::kLeft ? 1 : -1;
  for (const std::int32_t next : {(place + 1) % count, (place + count - 1) % count}) {
    const GridPoint& q = net_->Point(hull_->ring[static_cast<std::size_t>(next)]);
    for (const DirectionRange::Normal& n : {box.directions.first, box.directions.last}) {
      const double beyond = (q.column - corner.column) * n.x + (q.row - corner.row) * n.y;
      if (sign * beyond > 0) return false;
    }
  }
  const double most = std::max(box.from.height_m, box.to.height_m);
  if (corner.height_m < most - question.allowed_m) return false;
  const Offsets of_corner = box.Offsets(corner.column, corner.row);
  const Offsets of_other = box.Offsets(other.column, other.row);
  for (std::size_t c = 0; c < LineBox::kCorners; ++c) {
    if (sign * of_corner[c] < 0) continue;  // misses the surface
    const double height = HeightAtCrossing({corner, other}, of_corner[c], of_other[c]);
    if (height < box.HeightAt(c) - question.allowed_m) return false;
  }
  return true;
}

BoxVerdict OccludedLines::Ask(const BoxQuestion& question, std::vector<Occluder>& candidates) {
  const std::size_t count = candidates.size();
  const BoxVerdict verdict = AskBox(question, candidates, 0, count, 0);
  candidates.resize(count);
  return verdict;
}

BoxVerdict OccludedLines::AskBox(const BoxQuestion& question, std::vector<Occluder>& candidates,
                                 std::size_t begin, std::size_t end, int depth) {
  ++boxes_;
  const LineBox& box = question.box;
  const auto side_of = [](const Offsets& of) {
    const auto [least, most] = std::minmax_element(of.begin(), of.end());
    return *most <= 0 ? Side::kLeft : *least >= 0 ? Side::kRight : Side::kBoth;
  };
  const GridPoint middle = Middle(box.from, box.to);
  const DirectionRange::Normal normal = box.directions.Middle();
  const auto offset = [&](const GridPoint& p) {
    return (p.column - middle.column) * normal.x + (p.row - middle.row) * normal.y;
  };
  const auto distance = [&](const GridPoint& p) {
    return std::abs((p.column - middle.column) * normal.y - (p.row - middle.row) * normal.x);
  };
  double best = -std::numeric_limits<double>::infinity();
  double best_distance = hull_->reach;
  ends_.clear();
  const std::size_t kept = candidates.size();
  for (std::size_t i = begin; i < end; ++i) {
    const Occluder o = candidates[i];
    const Offsets of_a = box.Offsets(o.a.column, o.a.row);
    const Offsets of_b = box.Offsets(o.b.column, o.b.row);
    const Side a = side_of(of_a);
    const Side b = side_of(of_b);
    if (a == b && a != Side::kBoth) continue;
    if (a != Side::kBoth && b != Side::kBoth) {
      bool proven = true;
      for (std::size_t c = 0; c < LineBox::kCorners && proven; ++c) {
        proven = HeightAtCrossing(o, of_a[c], of_b[c]) >= box.HeightAt(c) - question.allowed_m;
      }
      if (proven) {
        candidates.resize(kept);
        return {true, 0};
      }
    } else if (a != Side::kBoth) {
      ends_.push_back({o.b_id, a, candidates.size()});
    } else if (b != Side::kBoth) {
      ends_.push_back({o.a_id, b, candidates.size()});
    }
    const double at_a = offset(o.a);
    const double at_b = offset(o.b);
    if ((at_a <= 0) != (at_b <= 0)) {
      const double height = HeightAtCrossing(o, at_a, at_b);
      if (height > best) {
        best = height;
        best_distance = std::max(distance(o.a), distance(o.b));
      }
    }
    candidates.push_back(o);
  }
  std::sort(ends_.begin(), ends_.end(), [](const LooseEnd& p, const LooseEnd& q) {
    return std::tie(p.id, p.other, p.candidate) < std::tie(q.id, q.other, q.candidate);
  });
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    bool proven = ProvenAtHull(question, candidates, ends_[i]);
    for (std::size_t j = i + 1; j < ends_.size() && ends_[j].id == ends_[i].id && !proven; ++j) {
      proven = ends_[i].other != ends_[j].other &&
               ProvenAtJoint(question, candidates, ends_[i], ends_[j]);
    }
    if (proven) {
      candidates.resize(kept);
      return {true, 0};
    }
  }
  const bool meets = best > -std::numeric_limits<double>::infinity() || !MissesNet(middle, normal);
  if (!meets && MissesNet(box)) {
    candidates.resize(kept);
    return {true, 0};
  }
  // On the middle line the surface is at `best`, or at the floor at most.
  const double excess = middle.height_m - std::max(best, question.floor_m);
  const bool attained = meets && excess > question.tolerated_m;
  if (attained || depth >= kMostHalvings) {
    candidates.resize(kept);
    return {!attained, attained ? excess : 0};
  }
  BoxQuestion half = question;
  BoxQuestion other = question;
  const double across = std::abs((box.to.column - box.from.column) * normal.x +
                                 (box.to.row - box.from.row) * normal.y);
  if (across > best_distance * box.directions.Width()) {
    half.box.to = middle;
    other.box.from = middle;
  } else {
    half.box.directions.last = normal;
    other.box.directions.first = normal;
  }
  const std::size_t stop = candidates.size();
  BoxVerdict verdict = AskBox(half, candidates, kept, stop, depth + 1);
  if (verdict.proven) verdict = AskBox(other, candidates, kept, stop, depth + 1);
  candidates.resize(kept);
  return verdict;
}

}  // namespace farhorizon
