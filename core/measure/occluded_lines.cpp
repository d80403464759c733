// Segments are tried one by one, by the corners of the box alone: one that occludes these occludes
// all of its lines. What is left of a box is halved, and the halves inherit the segments that may
// still help them. Halvings and looks are counted, so that the depth and the time of a question
// have a bound on any ground.
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
// Segments looked at for one question. Most take some hundred, nearly all below a hundred thousand.
constexpr std::int64_t kMostLooksOfAQuestion = 2'000'000;

double Cross(const GridPoint& o, const GridPoint& p, const GridPoint& q) {
  return (p.column - o.column) * (q.row - o.row) - (p.row - o.row) * (q.column - o.column);
}

// The height of a segment where it crosses a line, by its ends' offsets from the line, which have
// not the same sign. A segment in the line: its lower end.
double HeightAtCrossing(const GridPoint& a, const GridPoint& b, double of_a, double of_b) {
  const double whole = of_a - of_b;
  if (whole == 0) return std::min(a.height_m, b.height_m);
  return a.height_m + (b.height_m - a.height_m) * (of_a / whole);
}

// Whether a segment that all lines of the box cross occludes them: its ends by their offsets.
bool IsHighEnough(const BoxQuestion& question, const GridPoint& a, const GridPoint& b,
                  const Offsets& of_a, const Offsets& of_b) {
  for (std::size_t c = 0; c < LineBox::kCorners; ++c) {
    const double height = HeightAtCrossing(a, b, of_a[c], of_b[c]);
    if (height < question.box.HeightAt(c) - question.allowed_m) return false;
  }
  return true;
}

GridPoint Middle(const GridPoint& p, const GridPoint& q) {
  return {(p.column + q.column) / 2, (p.row + q.row) / 2, (p.height_m + q.height_m) / 2};
}

}  // namespace

NetHull NetHull::Of(const SkylineNet& net) {
  // The ends of segments, sorted, then the lower and the upper chain.
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
    left = left && std::all_of(of.begin(), of.end(), [](double o) { return o <= 0; });
    right = right && std::all_of(of.begin(), of.end(), [](double o) { return o >= 0; });
    if (!left && !right) return false;
  }
  return true;
}

bool OccludedLines::MissesNet(const GridPoint& through, DirectionRange::Normal normal) const {
  return MissesNet(LineBox{through, through, {normal, normal}});
}

bool OccludedLines::ProvenAtJoint(const BoxQuestion& question, const LooseEnd& left,
                                  const LooseEnd& right) const {
  const Occluder& l = candidates_[left.candidate];
  const Occluder& r = candidates_[right.candidate];
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
    const double height = HeightAtCrossing(joint, other, of_joint[c], of_other);
    if (height < box.HeightAt(c) - question.allowed_m) return false;
  }
  return true;
}

bool OccludedLines::ProvenAtHull(const BoxQuestion& question, const LooseEnd& end) const {
  const std::int32_t place = hull_->place[static_cast<std::size_t>(end.id)];
  if (place == kNoneThere) return false;
  const Occluder& o = candidates_[end.candidate];
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
    const double height = HeightAtCrossing(corner, other, of_corner[c], of_other[c]);
    if (height < box.HeightAt(c) - question.allowed_m) return false;
  }
  return true;
}

OccludedLines::MiddleLine OccludedLines::MiddleOf(const LineBox& box) const {
  return {Middle(box.from, box.to), box.directions.Middle(),
          -std::numeric_limits<double>::infinity(), hull_->reach};
}

void OccludedLines::Begin(const BoxQuestion& question) {
  last_look_ = looks_ + kMostLooksOfAQuestion;
  candidates_.clear();
  ends_.clear();
  question_ = question;
  line_ = MiddleOf(question.box);
}

OccludedLines::Side OccludedLines::SideOf(const Offsets& of) {
  if (std::max(std::max(of[0], of[1]), std::max(of[2], of[3])) <= 0) return Side::kLeft;
  if (std::min(std::min(of[0], of[1]), std::min(of[2], of[3])) >= 0) return Side::kRight;
  return Side::kBoth;
}

bool OccludedLines::ProvenBy(std::int32_t segment) {
  ++looks_;
  const SkylineNet::Segment& s = net_->segments[static_cast<std::size_t>(segment)];
  const GridPoint& a = net_->Point(s.a);
  const GridPoint& b = net_->Point(s.b);
  const LineBox& box = question_.box;
  const Offsets of_a = box.Offsets(a.column, a.row);
  const Offsets of_b = box.Offsets(b.column, b.row);
  const Side side_a = SideOf(of_a);
  const Side side_b = SideOf(of_b);
  return side_a != side_b && side_a != Side::kBoth && side_b != Side::kBoth &&
         IsHighEnough(question_, a, b, of_a, of_b);
}

bool OccludedLines::Offer(std::int32_t segment) {
  const SkylineNet::Segment& s = net_->segments[static_cast<std::size_t>(segment)];
  return Admit(question_, {net_->Point(s.a), net_->Point(s.b), s.a, s.b}, line_);
}

BoxVerdict OccludedLines::Conclude() { return Conclude(question_, line_, 0, 0); }

BoxVerdict OccludedLines::AskPart(const BoxQuestion& question, std::size_t begin, std::size_t end,
                                  int depth) {
  if (++looks_ > last_look_) return {.proven = false, .exhausted = true};
  ends_.clear();
  MiddleLine line = MiddleOf(question.box);
  BoxVerdict verdict{.proven = true};
  bool proven = false;
  for (std::size_t i = begin; i < end && !proven; ++i) {
    const Occluder o = candidates_[i];
    proven = Admit(question, o, line);
  }
  if (!proven) verdict = Conclude(question, line, end, depth);
  candidates_.resize(end);
  return verdict;
}

bool OccludedLines::Admit(const BoxQuestion& question, const Occluder& o, MiddleLine& line) {
  ++looks_;
  const LineBox& box = question.box;
  const Offsets of_a = box.Offsets(o.a.column, o.a.row);
  const Offsets of_b = box.Offsets(o.b.column, o.b.row);
  const Side a = SideOf(of_a);
  const Side b = SideOf(of_b);
  if (a == b && a != Side::kBoth) return false;
  if (a != Side::kBoth && b != Side::kBoth) {
    if (IsHighEnough(question, o.a, o.b, of_a, of_b)) return true;
  } else if (a != Side::kBoth) {
    ends_.push_back({o.b_id, a, candidates_.size()});
  } else if (b != Side::kBoth) {
    ends_.push_back({o.a_id, b, candidates_.size()});
  }
  candidates_.push_back(o);
  const auto offset = [&line](const GridPoint& p) {
    return (p.column - line.through.column) * line.normal.x +
           (p.row - line.through.row) * line.normal.y;
  };
  const double at_a = offset(o.a);
  const double at_b = offset(o.b);
  if ((at_a <= 0) == (at_b <= 0)) return false;
  const double height = HeightAtCrossing(o.a, o.b, at_a, at_b);
  if (height <= line.height_m) return false;
  const auto distance = [&line](const GridPoint& p) {
    return std::abs((p.column - line.through.column) * line.normal.y -
                    (p.row - line.through.row) * line.normal.x);
  };
  line.height_m = height;
  line.distance = std::max(distance(o.a), distance(o.b));
  return false;
}

bool OccludedLines::ProvenAtEnds(const BoxQuestion& question) {
  looks_ += std::ssize(ends_);
  std::sort(ends_.begin(), ends_.end(), [](const LooseEnd& p, const LooseEnd& q) {
    return std::tie(p.id, p.other, p.candidate) < std::tie(q.id, q.other, q.candidate);
  });
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    if (ProvenAtHull(question, ends_[i])) return true;
    for (std::size_t j = i + 1; j < ends_.size() && ends_[j].id == ends_[i].id; ++j) {
      if (ends_[i].other == ends_[j].other) continue;
      if (ProvenAtJoint(question, ends_[i], ends_[j])) return true;
    }
  }
  return false;
}

BoxVerdict OccludedLines::Conclude(const BoxQuestion& question, const MiddleLine& line,
                                   std::size_t begin, int depth) {
  const LineBox& box = question.box;
  if (ProvenAtEnds(question)) return {.proven = true};
  const bool crossed = line.height_m > -std::numeric_limits<double>::infinity();
  const bool meets = crossed || !MissesNet(line.through, line.normal);
  if (!meets && MissesNet(box)) return {.proven = true};
  // On the middle line the surface is at its height, or at the floor at most.
  const double excess = line.through.height_m - std::max(line.height_m, question.floor_m);
  const bool attained = meets && excess > question.tolerated_m;
  if (attained) return {.proven = false, .excess_m = excess};
  if (depth >= kMostHalvings) return {.proven = true};
  BoxQuestion half = question;
  BoxQuestion other = question;
  const double across = std::abs((box.to.column - box.from.column) * line.normal.x +
                                 (box.to.row - box.from.row) * line.normal.y);
  if (across > line.distance * box.directions.Width()) {
    half.box.to = line.through;
    other.box.from = line.through;
  } else {
    half.box.directions.last = line.normal;
    other.box.directions.first = line.normal;
  }
  const std::size_t end = candidates_.size();
  const BoxVerdict verdict = AskPart(half, begin, end, depth + 1);
  return verdict.proven ? AskPart(other, begin, end, depth + 1) : verdict;
}

}  // namespace farhorizon
