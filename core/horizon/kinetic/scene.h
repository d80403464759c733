#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "core/horizon/kinetic/moment.h"
#include "core/horizon/kinetic/moving_point.h"

namespace farhorizon::kinetic {

using PointId = std::int32_t;
using ClusterId = std::int32_t;
/// A tangent as one of its two hulls sees it: 2 * tangent + 0 or 1.
using SideId = std::int32_t;

inline constexpr std::int64_t kNever = std::int64_t{1} << 31;

/// A promise that holds until a moment in the queue; the stamp tells whether that one still counts.
struct Certificate {
  std::uint32_t stamp = 0;
  bool pending = false;
};

/// How often certificates failed, by what they promised.
struct SceneCounts {
  std::int64_t hull_failures = 0;  ///< three corners in line, or a point at the border of its hull
  std::int64_t inside_failures = 0;  ///< a point left its triangle
  std::int64_t left_hulls = 0;       ///< of those, points that were outside their hull then
  /// Figure 3.1: A two active scene bitangents, B active and inactive, C active and hull, D inactive
  /// and hull.
  std::array<std::int64_t, 4> tangent_failures{};
  std::int64_t hanging_failures = 0;  ///< two inactive ones
  std::int64_t merges = 0;
  std::int64_t clusters_max = 0;
  std::int64_t queue_max = 0;
};

/// Disjoint convex hulls of moving points, with the bitangents of each two of them.
///
/// The slice of the terrain at one depth, as chapter 3 of [Archambault03] keeps it, with merged hulls
/// (connected ground hides as its convex hull does) for contours. At every moment but those of events:
///  - corners of a cluster run counter-clockwise, every three strictly convex; certificate kHull for
///    each. Every other point that may come out again lies in a triangle of three points of the hull;
///    certificate kInside for it. So the corners are the hull.
///  - each two clusters have four tangents: two that leave both on one side (outer), two that part
///    them (inner). While both of these stand, the hulls are apart.
///  - round each hull goes its search tree (section 3.2.5), in two levels: an array of its corners, and
///    at each corner `lit`, the active tangents in order of direction. Going round, a tangent starts or
///    ends the hiding by the other hull. Between two neighbours in lit, or one and an edge of the hull,
///    is a gap: of visual lines or hidden, in turn. `depth` counts the hulls that hide the lines at the
///    corner's first edge; where it is 0, the first gap is free. A tangent beside visual lines is
///    active, and all that stand in hidden gaps are not.
///  - every tangent has certificates (kTangent) towards both sides. An active one: with its neighbours
///    in lit, or the hull's edge. An inactive one: with the border of its gap (an active tangent or the
///    hull's edge), the four kinds of figure 3.1, or with another inactive one that stands between.
///    Inactive ones are not ordered otherwise.
///
/// Where an active and an inactive tangent change places, the thesis gives all certificates of the one
/// to the other. Here they stay (`hanging`): the one that lost its place is certified with its
/// successor, and so is, through it, all that hangs on it: the tournament that chapter 5 asks for. So
/// three corners that come in line cost O(log k) in place of O(k), k hulls; but two inactive tangents
/// that become active part their gap, and all in it are looked at, as in lemma 3.13.
///
/// A new hull (lemma 3.5): for each of the others, its four tangents by search, and at each corner
/// between a start and its end, where visual lines were, the active ones there are taken out. Depths do
/// for the rest: O(h + log k) a pair, h the corners on the way.
///
/// Ground at or above the plane only grows, so visual lines are never born: a tangent becomes active
/// only where it passes one that is (or its hulls are new), and there all three supports are looked at.
///
/// Simultaneous events are one step. Three corners in line and nothing else are handled in place, and
/// checked by the signs of the predicates just after the moment; what is touched by anything else is
/// put in order anew by those signs (Rebuild). What is then still in line is so for good; such ties are
/// broken by one rule: hiding starts before it ends, then by id. A gap between two tied tangents has no
/// width and shows nothing.
class Scene {
 public:
  /// A point that is in `cluster` from the coming Settle() until depth `end`. tag: the caller's.
  PointId Add(ClusterId cluster, const MovingPoint& path, std::int64_t end, std::int32_t tag);
  ClusterId NewCluster();
  /// Makes the two one: connected ground. Returns the one that is left.
  ClusterId Join(ClusterId a, ClusterId b);
  /// The point is no more, from the coming Settle() on.
  void Remove(PointId point);
  /// The one that `cluster` has become part of.
  ClusterId Find(ClusterId cluster);

  /// When the next certificate fails.
  std::optional<Moment> NextFailure();
  /// Goes to `now` and takes its failures out of the queue. Requires: none earlier is in it.
  void Advance(const Moment& now);
  /// Puts everything right just after the moment gone to.
  void Settle();

  /// The cluster whose hull, just now (not just after), has the standing point in it or on its border;
  /// -1 if none. Requires: a whole moment, before anything was changed.
  [[nodiscard]] ClusterId Around(std::int64_t x, std::int64_t y) const;
  /// Whether the two hulls have a point in common at depth s, as it is reached. Exact.
  [[nodiscard]] bool MeetAt(ClusterId a, ClusterId b, std::int64_t s) const;

  struct Tangent {
    std::array<PointId, 2> touch{-1, -1};
    struct Key {
      std::array<PointId, 3> points{-1, -1, -1};
      int sign = 0;
      friend bool operator==(const Key&, const Key&) = default;
    };
    struct Side {
      bool active = false;
      std::array<Certificate, 2> certificates;  ///< with what is before, after it
      std::array<Key, 2> keys;
      /// The other tangent; -1: the hull's edge; itself: none, the one after has it.
      std::array<SideId, 2> with{-1, -1};
      /// How many have their certificate towards what is before (0), after (1) them with this one.
      std::array<std::int32_t, 2> hanging{};
    };
    std::array<Side, 2> sides;
  };
  struct Point {
    MovingPoint path;
    std::int64_t end = 0;
    std::int32_t tag = 0;
    ClusterId cluster = -1;
    bool alive = true;
    bool corner = false;
    bool touched = false;  ///< its tangents' order and activities are to be found anew
    bool shaken = false;   ///< and they may not stand there any more
    bool seen = false;     ///< visual lines with a width touched it
    PointId prev = -1;
    PointId next = -1;
    std::int32_t index = 0;  ///< in its cluster's corners
    int depth = 0;
    std::vector<SideId> sides;  ///< in no order
    std::vector<SideId> lit;
    Certificate hull;
    Certificate inside;
  };
  struct Cluster {
    std::int32_t slot = -1;  ///< row in the table of tangents
    bool dirty = false;      ///< corners are to be found anew
    bool fresh = false;      ///< no tangents yet
    bool recount = false;    ///< corners are others, or tangents moved among them
    bool listed = false;
    std::vector<PointId> corners;
    std::vector<PointId> loose;
  };
  [[nodiscard]] const Point& point(PointId p) const { return points_[Index(p)]; }
  [[nodiscard]] const Cluster& cluster(ClusterId c) const { return clusters_[Index(c)]; }
  [[nodiscard]] std::span<const ClusterId> apart() const { return apart_; }
  [[nodiscard]] PointId point_count() const { return static_cast<PointId>(points_.size()); }
  [[nodiscard]] const SceneCounts& counts() const { return counts_; }
  [[nodiscard]] std::int64_t queue_size() const { return live_; }

  /// Four a pair of clusters: outer, outer, inner, inner.
  [[nodiscard]] std::int32_t FirstTangent(ClusterId a, ClusterId b) const;
  [[nodiscard]] const Tangent& tangent(std::int32_t t) const { return tangents_[Index(t)]; }
  static bool Outer(SideId side) { return side / 2 % 4 < 2; }
  /// Whether the other hull is touched ahead along the tangent's direction, the own hull on its left.
  static bool Ahead(SideId side) {
    const int kind = side / 2 % 4;
    return kind < 2 ? kind == side % 2 : kind == 2;
  }
  static bool Starts(SideId side) { return Outer(side) == Ahead(side); }
  [[nodiscard]] PointId Own(SideId side) const { return tangent(side / 2).touch[side % 2 ? 1 : 0]; }
  [[nodiscard]] PointId Other(SideId side) const {
    return tangent(side / 2).touch[side % 2 ? 0 : 1];
  }
  [[nodiscard]] bool Active(SideId side) const {
    return tangent(side / 2).sides[side % 2 ? 1 : 0].active;
  }

  /// Whether the directions between two tangents or hull edges (-1) at a corner, in this order, have
  /// an inside just after the moment.
  [[nodiscard]] bool HasWidth(PointId p, SideId before, SideId after) const;

  /// Throws InternalError where an invariant does not hold just after the moment: for tests.
  void CheckAll() const;

 private:
  enum class Promise : std::uint8_t { kHull, kInside, kTangent };
  struct Failure {
    Moment at;
    Promise promise;
    std::uint32_t stamp;
    std::int32_t id;
  };
  struct Later {
    bool operator()(const Failure& a, const Failure& b) const { return Compare(a.at, b.at) > 0; }
  };
  static constexpr std::size_t Index(std::int32_t i) { return static_cast<std::size_t>(i); }

  // scene.cpp: the queue
  Certificate& CertificateOf(Promise promise, std::int32_t id);
  void Cancel(Certificate& certificate);
  void Schedule(Promise promise, std::int32_t id, const std::optional<Moment>& at);
  void Fail(Promise promise, std::int32_t id);
  void FailTangent(SideId side, std::size_t which);
  void Touch(PointId p);
  void TouchAround(PointId p);
  void Shake(PointId p);
  void List(ClusterId c);
  [[nodiscard]] int Orient(PointId a, PointId b, PointId c) const {
    return OrientAfter(point(a).path, point(b).path, point(c).path, now_);
  }
  [[nodiscard]] std::int64_t FirstEnd(PointId a, PointId b, PointId c) const;
  Tangent::Side& SideOf(SideId side) { return tangents_[Index(side / 2)].sides[side % 2 ? 1 : 0]; }

  // hulls.cpp
  void SettleHull(ClusterId c);
  [[nodiscard]] std::vector<PointId> HullOf(std::vector<PointId> candidates) const;
  void SetCorners(ClusterId c, std::vector<PointId> corners);
  struct Triangle {
    std::array<PointId, 3> corners;
  };
  [[nodiscard]] std::optional<Triangle> Locate(ClusterId c, const MovingPoint& p) const;
  void KeepInside(PointId p);
  struct Box {
    double left = 1e30;
    double right = -1e30;
    double top = 1e30;
    double bottom = -1e30;
  };
  [[nodiscard]] Box BoxOf(ClusterId c, double s, double margin) const;
  template <typename Turn>
  [[nodiscard]] bool AddObstacle(ClusterId a, ClusterId b, double s, double off,
                                 const Turn& turn) const;
  [[nodiscard]] bool AddObstacle(ClusterId a, ClusterId b) const;
  [[nodiscard]] bool JoinFresh();
  [[nodiscard]] bool JoinAcross(SideId side);
  void ShakePassed();
  [[nodiscard]] bool MergeWhatMeets();

  // tangents.cpp
  [[nodiscard]] int StepAt(SideId side) const;
  [[nodiscard]] bool Stands(std::int32_t tangent) const;
  [[nodiscard]] bool CrossEdge(SideId side);
  void CrossEdges();
  void WalkFreely(std::int32_t tangent);
  void Walk(std::int32_t tangent);
  struct Arc {
    SideId start = -1;
    SideId end = -1;
  };
  static std::array<Arc, 2> ArcsOf(std::int32_t first, SideId k);
  void HideArc(const Arc& arc);
  void ReleaseArcs();
  void TouchWhatIsInLine(SideId side);
  void MakeTangents(ClusterId a, ClusterId b);
  void DropTangents(ClusterId a, ClusterId b);
  void Recount(ClusterId c);
  void WalkShaken();
  void LookAtTouched(PointId p);
  void LookAtAllTouched();
  void UpdateTangents();

  // gaps.cpp
  [[nodiscard]] bool Before(SideId a, SideId b) const;
  [[nodiscard]] std::size_t LitIndex(PointId p, SideId side) const;
  [[nodiscard]] bool FreeAt(PointId p, std::size_t gap) const;
  [[nodiscard]] SideId LitOr(PointId p, std::size_t index) const;
  void Shade(PointId p, SideId from, SideId to);
  void SortSides(PointId p);
  void Rebuild(PointId p);
  void LightUp(PointId p);
  void TakeOff(PointId p, SideId side);
  void Rehang(SideId side, std::size_t which);
  [[nodiscard]] bool Holds(SideId side, std::size_t which) const;
  void Renew(SideId side);
  void Relink(PointId p, std::size_t index);
  void Certify(SideId side, std::size_t which, SideId with);

  // passing.cpp
  struct Passed {
    SideId side;
    std::size_t which;
    SideId with;
    std::array<PointId, 3> points;
  };
  struct Pair {
    PointId at;
    SideId first;
    SideId second;
  };
  [[nodiscard]] std::optional<std::size_t> PlaceOfGap(const Pair& pair) const;
  [[nodiscard]] std::optional<std::size_t> PlaceOfCollapse(PointId p, SideId active,
                                                           SideId other) const;
  [[nodiscard]] std::optional<std::size_t> PlaceOfExchange(PointId p, SideId active,
                                                           SideId other) const;
  [[nodiscard]] std::optional<std::size_t> PlaceOf(const Pair& pair) const;
  void Collapse(const Pair& pair, std::size_t index);
  void Exchange(const Pair& pair, std::size_t index);
  void Part(const Pair& pair, std::size_t index);
  [[nodiscard]] bool PassThree(const Passed& passed);
  void PassTangents();

  // check.cpp
  void CheckPair(ClusterId c, ClusterId other) const;
  void CheckCorner(PointId p) const;
  void CheckChain(SideId side, std::size_t which) const;

  Moment now_;
  std::vector<Point> points_;
  std::vector<Cluster> clusters_;
  std::vector<ClusterId> roots_;
  std::vector<ClusterId> apart_;
  std::vector<ClusterId> in_slot_;
  std::vector<Tangent> tangents_;
  std::priority_queue<Failure, std::vector<Failure>, Later> queue_;
  std::int64_t live_ = 0;
  std::vector<PointId> touched_;
  std::vector<PointId> shaken_;
  std::vector<Passed> passed_;
  std::vector<std::pair<PointId, PointId>> released_;  ///< corners at which arcs began and ended
  std::vector<int> turns_;
  std::vector<std::pair<Aim, SideId>> aimed_;
  /// Inactive, and failed with an edge of their own hull; at their corner then.
  std::vector<std::pair<SideId, PointId>> crossed_;
  std::vector<ClusterId> listed_;
  std::vector<PointId> unsettled_;
  SceneCounts counts_;
};

}  // namespace farhorizon::kinetic
