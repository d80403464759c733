#pragma once

#include <cstdint>
#include <vector>

#include "core/measure/line_box.h"
#include "core/measure/skyline_net.h"

namespace farhorizon {

/// The convex hull of a net's points in plan, turning one way, without points on its sides; and
/// where each point is on it, kNoneThere inside. reach: how far some point is from the first one.
struct NetHull {
  std::vector<std::int32_t> ring;
  std::vector<std::int32_t> place;
  double reach = 0;

  static NetHull Of(const SkylineNet& net);
};

/// What is known of a box of lines.
///
/// proven: the box's segment, lowered by the allowance, is on each line of the box that meets the
///   net's surface, and not with its outermost points alone, no higher than that surface.
/// exhausted: it is not known, as that would have taken too long.
/// excess_m: otherwise, by how much the segment is above the surface on some line of the box, at
///   least: more than what was tolerated.
struct BoxVerdict {
  bool proven = false;
  bool exhausted = false;
  double excess_m = 0;
};

/// How a box is asked.
///
/// allowed_m: the allowance. tolerated_m: less than that; a line with more is reported, so that
///   between both there is room for a proof by boxes.
/// floor_m: segments that are nowhere above this height are missing among the occluders.
struct BoxQuestion {
  LineBox box;
  double allowed_m = 0;
  double tolerated_m = 0;
  double floor_m = 0;
};

/// Proves that boxes of lines are occluded, by cutting them up.
///
/// A segment that all lines of a box cross is lowest, against the box's own segment, at a corner:
/// in a fixed direction both heights are linear along the box's segment, and about a fixed point
/// the line's crossing moves one way along the occluder. Two segments with a common end which all
/// lines cross, some the one and some the other, are lowest at a corner or at that end. A box that
/// neither proves is halved, along its segment or in its directions, whichever moves lines more
/// at the best occluder of its middle line.
class OccludedLines {
 public:
  OccludedLines(const SkylineNet& net, const NetHull& hull) : net_(&net), hull_(&hull) {}

  /// Begins with a question.
  void Begin(const BoxQuestion& question);
  /// Whether a segment of the net alone proves the box, without taking it.
  [[nodiscard]] bool ProvenBy(std::int32_t segment);
  /// Takes a segment of the net; true where it alone proves the box, and there is no more to do.
  bool Offer(std::int32_t segment);
  /// The answer. Requires: every segment that is above question.floor_m anywhere and meets a line
  ///   of the box has been offered, once; others do not matter.
  BoxVerdict Conclude();

  /// Segments looked at so far, again for each box: what the time goes with.
  [[nodiscard]] std::int64_t looks() const { return looks_; }

 private:
  enum class Side : std::uint8_t { kLeft, kRight, kBoth };  // of all lines of a box, or of some

  // A segment that may occlude lines of the box.
  struct Occluder {
    GridPoint a;
    GridPoint b;
    std::int32_t a_id;
    std::int32_t b_id;
  };
  // The middle line of a box and the highest occluder over it: its height there, and how far along
  // the line its further end is.
  struct MiddleLine {
    GridPoint through;
    DirectionRange::Normal normal;
    double height_m;
    double distance;
  };
  // An end that is between the box's lines, of a segment whose other end is not.
  struct LooseEnd {
    std::int32_t id;
    Side other;
    std::size_t candidate;
  };

  // Of a point, by its offsets from the corners of the box.
  [[nodiscard]] static Side SideOf(const std::array<double, LineBox::kCorners>& of);
  [[nodiscard]] MiddleLine MiddleOf(const LineBox& box) const;
  // Of candidates [begin, end), for one half of a box after `depth` halvings.
  BoxVerdict AskPart(const BoxQuestion& question, std::size_t begin, std::size_t end, int depth);
  // Takes the segment among the candidates where it may matter; true where it alone proves the box.
  bool Admit(const BoxQuestion& question, const Occluder& o, MiddleLine& line);
  bool ProvenAtEnds(const BoxQuestion& question);
  [[nodiscard]] bool ProvenAtJoint(const BoxQuestion& question, const LooseEnd& left,
                                   const LooseEnd& right) const;
  [[nodiscard]] bool ProvenAtHull(const BoxQuestion& question, const LooseEnd& end) const;
  // Of a box of which no candidate alone, of those from `begin` on, proves the whole.
  BoxVerdict Conclude(const BoxQuestion& question, const MiddleLine& line, std::size_t begin,
                      int depth);
  [[nodiscard]] bool MissesNet(const LineBox& box) const;
  [[nodiscard]] bool MissesNet(const GridPoint& through, DirectionRange::Normal normal) const;

  const SkylineNet* net_;
  const NetHull* hull_;
  BoxQuestion question_;
  MiddleLine line_{};
  std::int64_t looks_ = 0;
  std::int64_t last_look_ = 0;        // for the present question
  std::vector<Occluder> candidates_;  // a stack: those of a half box follow those of the whole
  std::vector<LooseEnd> ends_;        // of the present box
};

}  // namespace farhorizon
