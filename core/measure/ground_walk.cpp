// A side of the mesh is cut where it crosses the grid's rows, columns and diagonals. Between two
// cuts both surfaces are straight below it, so their difference is greatest at a cut. The cuts at
// which it crosses a horizon edge are the places where that edge's height above the mesh can be
// greatest, besides the edge's ends.
#include "core/measure/ground_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "core/base/infinity.h"
#include "core/measure/ground_below.h"
#include "core/measure/in_hull.h"

namespace farhorizon {

namespace {

constexpr float kNoRise = -std::numeric_limits<float>::infinity();

// Pieces are joined up to this length, columns or rows: longer ones are fewer, but each of them is
// at its highest end's height for the first tests. Any value is sound.
constexpr double kLongestPiece = 2;

// Where a segment passes whole numbers of a coordinate that runs from `from` by `run`: in rising
// order of t in (0, 1).
class Cuts {
 public:
  Cuts(double from, double run) : from_(from), run_(run) {
    if (run == 0) return;
    next_ = run > 0 ? std::floor(from) + 1 : std::ceil(from) - 1;
    step_ = run > 0 ? 1 : -1;
    Set();
  }

  [[nodiscard]] double t() const { return t_; }  // infinity after the last one
  [[nodiscard]] double number() const { return next_; }

  void Advance() {
    next_ += step_;
    Set();
  }

 private:
  void Set() {
    t_ = (next_ - from_) / run_;
    if (!(t_ < 1)) t_ = kInfinity;
  }

  double from_;
  double run_;
  double next_ = 0;
  double step_ = 0;
  double t_ = kInfinity;
};

// Where the mesh's outline crosses a horizon edge: as a share of the way from its end a to b.
struct MeshEnd {
  std::int32_t edge = 0;
  double along = 0;
};

class Walker {
 public:
  Walker(const Terrain& terrain, const Horizon& horizon, const HorizonIndex& index,
         double allowed_m)
      : dem_(terrain.dem()),
        horizon_(horizon),
        index_(index),
        allowed_m_(allowed_m),
        sunk_(horizon.edges.size(), 0) {}

  void WalkSide(const GridPoint& p, const GridPoint& q, bool ridge, bool outline) {
    const double run = q.column - p.column;
    const double rise = q.row - p.row;
    std::array<Cuts, 3> cuts = {Cuts(p.column, run), Cuts(p.row, rise),
                                Cuts(p.column - p.row, run - rise)};
    const auto at = [&](double t) {
      return GridPoint{p.column + t * run, p.row + t * rise, std::lerp(p.height_m, q.height_m, t)};
    };
    GridPoint from = p;
    piece_.reset();
    for (;;) {
      std::size_t k = 0;
      if (cuts[1].t() < cuts[k].t()) k = 1;
      if (cuts[2].t() < cuts[k].t()) k = 2;
      const double t = cuts[k].t();
      const bool last = !(t < 1);
      const GridPoint to = last ? q : at(t);
      WalkPiece(from, to, ridge, outline);
      if (last) break;
      CrossEdge(to, k, cuts[k].number(), outline);
      cuts[k].Advance();
      from = to;
    }
    Flush();
  }

  GroundWalk Take(const Terrain& terrain, const std::vector<float>& rise) && {
    Flush();
    std::sort(ends_.begin(), ends_.end(), [](const MeshEnd& p, const MeshEnd& q) {
      return std::tie(p.edge, p.along) < std::tie(q.edge, q.along);
    });
    for (std::size_t i = 0; i < sunk_.size(); ++i) {
      const Edge e = horizon_.edges[i].edge;
      const double at_a = -rise[static_cast<std::size_t>(e.a)];
      const double at_b = -rise[static_cast<std::size_t>(e.b)];
      // The other diagonal, which cells beside a hole may have, is not among those that are cut at.
      const bool cut = dem_.Column(e.b) >= dem_.Column(e.a);
      const double sunk = cut ? std::max({sunk_[i], at_a, at_b}) : kInfinity;
      result_.most_m = std::max(result_.most_m, sunk);
      sunk_[i] = sunk;
      if (sunk <= allowed_m_) continue;
      const Terrain::Faces faces = terrain.FacesOf(e);
      if (!faces.left || !faces.right) {
        result_.dem_raised.push_back({PointAt(e.a), PointAt(e.b), true, true});
      } else if (at_a == kInfinity || at_b == kInfinity) {
        AppendUncovered(static_cast<std::int32_t>(i), rise);
      } else {
        result_.dem_raised.push_back({PointAt(e.a), PointAt(e.b), false, index_.inner()[i] == 0});
      }
    }
    for (const float at : rise) {
      if (std::isfinite(at)) {
        result_.common_m = std::max(result_.common_m, static_cast<double>(std::abs(at)));
      }
    }
    result_.sunk_m = std::move(sunk_);
    return std::move(result_);
  }

 private:
  [[nodiscard]] GridPoint PointAt(VertexId v) const {
    return {static_cast<double>(dem_.Column(v)), static_cast<double>(dem_.Row(v)), dem_.HeightM(v)};
  }

  void WalkPiece(const GridPoint& p, const GridPoint& q, bool ridge, bool outline) {
    const std::optional<GroundPiece> ground = GroundBelow(dem_, p, q, false);
    if (const std::optional<GroundPiece> plane = GroundBelow(dem_, p, q, true)) {
      result_.common_m = std::max({result_.common_m, std::abs(p.height_m - plane->from_m),
                                   std::abs(q.height_m - plane->to_m)});
    }
    if (ground) {
      const double most = std::max(p.height_m - ground->from_m, q.height_m - ground->to_m);
      result_.most_m =
          std::max({result_.most_m, most, ground->from_m - p.height_m, ground->to_m - q.height_m});
      if (most <= allowed_m_ || !ridge) return Flush();
      if (IsInHull(dem_, horizon_.hulls, p, q, -allowed_m_)) return Flush();
    } else if (!ridge) {
      return Flush();
    } else {
      result_.most_m = kInfinity;
    }
    outline = outline || !ground;
    const bool near = outline || NearOutline(ground->cell);
    if (piece_ && piece_->outline == outline && piece_->near_outline == near &&
        Length(piece_->a, q) <= kLongestPiece) {
      piece_->b = q;
      return;
    }
    Flush();
    piece_ = RaisedPiece{p, q, outline, near};
  }

  [[nodiscard]] bool NearOutline(VertexId nw) const {
    const std::vector<bool>& posts = index_.outline_posts();
    const auto at = static_cast<std::size_t>(nw);
    const std::size_t below = at + static_cast<std::size_t>(dem_.columns);
    return posts[at] || posts[at + 1] || posts[below] || posts[below + 1];
  }

  static double Length(const GridPoint& p, const GridPoint& q) {
    return std::max(std::abs(p.column - q.column), std::abs(p.row - q.row));
  }

  void Flush() {
    if (piece_) result_.mesh_raised.push_back(*piece_);
    piece_.reset();
  }

  // The side is at p over a line of the grid: of column (0), row (1) or diagonal (2) `number`.
  void CrossEdge(const GridPoint& p, std::size_t family, double number, bool outline) {
    const double along = family == 0 ? p.row : p.column;
    const double begin = std::floor(along);
    const auto i = static_cast<std::int32_t>(begin);
    const auto n = static_cast<std::int32_t>(number);
    const std::int32_t column = family == 0 ? n : i;
    const std::int32_t row = family == 0 ? i : family == 1 ? n : i - n;
    const std::int32_t to_column = family == 0 ? column : column + 1;
    const std::int32_t to_row = family == 1 ? row : row + 1;
    if (column < 0 || row < 0 || to_column >= dem_.columns || to_row >= dem_.rows) return;
    const VertexId a = row * dem_.columns + column;
    const VertexId b = to_row * dem_.columns + to_column;
    const std::int32_t edge = index_.Find(a, b);
    if (edge == kNoneThere) return;
    const double ground = std::lerp(dem_.HeightM(a), dem_.HeightM(b), along - begin);
    double& sunk = sunk_[static_cast<std::size_t>(edge)];
    sunk = std::max(sunk, ground - p.height_m);
    if (outline) ends_.push_back({edge, along - begin});
  }

  // Appends a horizon edge of which the mesh has no ground somewhere below: as far as that goes, as
  // part of an outline.
  void AppendUncovered(std::int32_t i, const std::vector<float>& rise) {
    const Edge e = horizon_.edges[static_cast<std::size_t>(i)].edge;
    const bool has_a = rise[static_cast<std::size_t>(e.a)] != kNoRise;
    const bool has_b = rise[static_cast<std::size_t>(e.b)] != kNoRise;
    double from = 0;  // the part between is covered
    double to = 1;
    const auto [first, last] =
        std::equal_range(ends_.begin(), ends_.end(), MeshEnd{i, 0},
                         [](const MeshEnd& p, const MeshEnd& q) { return p.edge < q.edge; });
    if (first == last || (has_a && has_b)) {
      to = 0;
    } else {
      const auto [least, most] = std::minmax_element(
          first, last, [](const MeshEnd& p, const MeshEnd& q) { return p.along < q.along; });
      if (!has_a) from = has_b ? most->along : least->along;
      if (!has_b) to = has_a ? least->along : most->along;
    }
    const GridPoint a = PointAt(e.a);
    const GridPoint b = PointAt(e.b);
    const auto at = [&](double t) {
      return GridPoint{std::lerp(a.column, b.column, t), std::lerp(a.row, b.row, t),
                       std::lerp(a.height_m, b.height_m, t)};
    };
    if (from >= to) {
      result_.dem_raised.push_back({a, b, true, true});
      return;
    }
    if (from > 0) result_.dem_raised.push_back({a, at(from), true, true});
    result_.dem_raised.push_back({at(from), at(to), false, true});
    if (to < 1) result_.dem_raised.push_back({at(to), b, true, true});
  }

  const Dem& dem_;
  const Horizon& horizon_;
  const HorizonIndex& index_;
  double allowed_m_;
  std::vector<double> sunk_;  // per horizon edge, where sides cross it
  std::vector<MeshEnd> ends_;
  std::optional<RaisedPiece> piece_;
  GroundWalk result_;
};

}  // namespace

GroundWalk WalkGround(const Terrain& terrain, const Horizon& horizon, const HorizonIndex& index,
                      const GridMesh& mesh, const MeshSides& sides, const std::vector<float>& rise,
                      double allowed_m) {
  Walker walker(terrain, horizon, index, allowed_m);
  for (const MeshSide& side : sides.sides) {
    walker.WalkSide(mesh.points[static_cast<std::size_t>(side.a)],
                    mesh.points[static_cast<std::size_t>(side.b)], IsRidgeOrOutline(mesh, side),
                    side.IsOutline());
  }
  return std::move(walker).Take(terrain, rise);
}

}  // namespace farhorizon
