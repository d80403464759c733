// Each triangle's rows of posts are gone through. Posts that are in none are compared with the
// outline.
#include "core/measure/post_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/measure/row_crossings.h"
#include "core/measure/verticals.h"

namespace farhorizon {

namespace {

// A post that the mesh misses in plan by no more than this counts as covered, columns or rows.
constexpr double kMostMissed = 0.5;
// One that it misses by no more than this is also compared with the plane of the triangle at the
// outline: rounding a vertex for a file moves it by less.
constexpr double kRounded = 0.0625;
constexpr std::size_t kTrianglesBetweenChecks = 4096;
constexpr float kNotMet = -1;
constexpr float kNoRise = -std::numeric_limits<float>::infinity();

class PostMeasurer {
 public:
  PostMeasurer(const Terrain& terrain, const std::vector<std::uint8_t>& is_vertex,
               const PostPlaces& places, const PlacedMesh& mesh, const MeshSides& sides)
      : dem_(terrain.dem()),
        is_vertex_(is_vertex),
        places_(places),
        mesh_(mesh),
        sides_(sides),
        verticals_(terrain.dem(), places, mesh, sides),
        errors_(dem_.heights.size(), kNotMet) {
    result_.rise.assign(dem_.heights.size(), kNoRise);
  }

  Status Run(const RunControl& control) {
    for (std::size_t t = 0; t < mesh_.grid.triangles.size(); ++t) {
      if (t % kTrianglesBetweenChecks == 0 && control.StopRequested()) {
        return Error{ErrorCode::kCancelled, "stopped while measuring heights at posts"};
      }
      MeasureTriangle(static_cast<std::int32_t>(t));
    }
    MeasureAtOutline();
    return Ok{};
  }

  Result<PostErrors> Take() && {
    double squares = 0;
    std::int64_t covered = 0;
    std::int64_t posts = 0;
    for (std::size_t v = 0; v < errors_.size(); ++v) {
      if (is_vertex_[v] == 0) continue;
      ++posts;
      if (errors_[v] < 0) continue;
      const double error = errors_[v];
      result_.vertical.max_m = std::max(result_.vertical.max_m, error);
      squares += error * error;
      ++covered;
    }
    if (covered == 0) {
      return Error{ErrorCode::kUnsupportedData, "the mesh covers no post of the DEM", "bad-mesh"};
    }
    result_.vertical.rms_m = std::sqrt(squares / static_cast<double>(covered));
    result_.covered_share = static_cast<double>(covered) / static_cast<double>(posts);
    return std::move(result_);
  }

 private:
  using Corners = std::array<std::int32_t, 3>;

  [[nodiscard]] const Corners& CornersOf(std::int32_t t) const {
    return mesh_.grid.triangles[static_cast<std::size_t>(t)];
  }
  [[nodiscard]] const GridPoint& Point(std::int32_t i) const {
    return mesh_.grid.points[static_cast<std::size_t>(i)];
  }
  void MeasureTriangle(std::int32_t t) {
    const Corners& corners = CornersOf(t);
    const GridPoint& a = Point(corners[0]);
    const GridPoint& b = Point(corners[1]);
    const GridPoint& c = Point(corners[2]);
    const double ux = b.column - a.column;
    const double uy = b.row - a.row;
    const double vx = c.column - a.column;
    const double vy = c.row - a.row;
    const double area = ux * vy - uy * vx;
    const double dz_b = b.height_m - a.height_m;
    const double dz_c = c.height_m - a.height_m;
    const double least = std::min({a.height_m, b.height_m, c.height_m});
    const double most = std::max({a.height_m, b.height_m, c.height_m});
    const bool in_grid = places_.positions.empty();
    ForEachRow(
        mesh_.grid, corners, {}, dem_.columns, dem_.rows, [&](std::int32_t r, const RowPart& part) {
          for (std::int32_t column = part.first; column < part.end; ++column) {
            const VertexId v = r * dem_.columns + column;
            if (is_vertex_[static_cast<std::size_t>(v)] == 0) continue;
            const double x = column - a.column;
            const double y = r - a.row;
            // Between the corners' heights, however thin the triangle is.
            const double height = std::clamp(
                a.height_m + ((x * vy - y * vx) * dz_b + (ux * y - uy * x) * dz_c) / area, least,
                most);
            const double rise = height - dem_.HeightM(v);
            Add(v, rise, in_grid ? std::abs(rise) : verticals_.DistanceAt(v, t).value_or(kNotMet));
          }
        });
  }

  void Add(VertexId v, double rise, double distance) {
    const auto at = static_cast<std::size_t>(v);
    if (result_.rise[at] != kNoRise) ++result_.covered_twice;
    result_.rise[at] = std::max(result_.rise[at], static_cast<float>(rise));
    errors_[at] = std::max(errors_[at], RoundedUp(distance));
  }

  static float RoundedUp(double value) {
    const auto rounded = static_cast<float>(value);
    return rounded < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                           : rounded;
  }

  // A post that is in no triangle, and how far the outline is from it.
  struct Missed {
    VertexId post;
    double distance;  // squared
    double error;
    double rise;
  };

  void MeasureAtOutline() {
    std::vector<Missed> missed;
    for (const MeshSide& side : sides_.sides) {
      if (side.IsOutline()) FindMissed(side, missed);
    }
    std::sort(missed.begin(), missed.end(), [](const Missed& p, const Missed& q) {
      return p.post != q.post           ? p.post < q.post
             : p.distance != q.distance ? p.distance < q.distance
                                        : p.error > q.error;
    });
    for (std::size_t i = 0; i < missed.size(); ++i) {
      if (i > 0 && missed[i].post == missed[i - 1].post) continue;
      const auto at = static_cast<std::size_t>(missed[i].post);
      errors_[at] = RoundedUp(missed[i].error);
      if (missed[i].distance == 0) result_.rise[at] = static_cast<float>(missed[i].rise);
    }
  }

  // Appends the posts near one side of the outline that no triangle has.
  void FindMissed(const MeshSide& side, std::vector<Missed>& missed) const {
    const GridPoint& p = Point(side.a);
    const GridPoint& q = Point(side.b);
    const double dx = q.column - p.column;
    const double dy = q.row - p.row;
    const double squared = dx * dx + dy * dy;
    // Along the longer axis, so that only posts close to the side are looked at.
    const bool by_row = std::abs(dy) > std::abs(dx);
    const double from = (by_row ? std::min(p.row, q.row) : std::min(p.column, q.column));
    const double to = (by_row ? std::max(p.row, q.row) : std::max(p.column, q.column));
    const auto first = static_cast<std::int32_t>(std::ceil(std::max(from - kMostMissed, 0.0)));
    const double last = std::min<double>(to + kMostMissed, (by_row ? dem_.rows : dem_.columns) - 1);
    for (std::int32_t i = first; i <= last; ++i) {
      const double along =
          by_row ? (dy != 0 ? (i - p.row) / dy : 0) : (dx != 0 ? (i - p.column) / dx : 0);
      const double t = std::clamp(along, 0.0, 1.0);
      const double middle = by_row ? p.column + t * dx : p.row + t * dy;
      // A post within half a cell of the side is within that times the square root of 2 along the
      // shorter axis.
      for (auto j = static_cast<std::int32_t>(std::ceil(middle - 1)); j <= middle + 1; ++j) {
        const std::int32_t column = by_row ? j : i;
        const std::int32_t row = by_row ? i : j;
        if (column < 0 || row < 0 || column >= dem_.columns || row >= dem_.rows) continue;
        const VertexId v = row * dem_.columns + column;
        if (is_vertex_[static_cast<std::size_t>(v)] == 0 ||
            errors_[static_cast<std::size_t>(v)] >= 0) {
          continue;
        }
        const double nearest =
            squared > 0
                ? std::clamp(((column - p.column) * dx + (row - p.row) * dy) / squared, 0.0, 1.0)
                : 0;
        const double off_x = p.column + nearest * dx - column;
        const double off_y = p.row + nearest * dy - row;
        const double distance = off_x * off_x + off_y * off_y;
        if (distance <= kMostMissed * kMostMissed) {
          missed.push_back(Miss(side, v, nearest, distance));
        }
      }
    }
  }

  [[nodiscard]] Missed Miss(const MeshSide& side, VertexId v, double t, double distance) const {
    const bool rounded = distance <= kRounded * kRounded;
    const double error = verticals_.DistanceAtOutline(v, side, t, rounded);
    return {v, distance, error,
            std::lerp(Point(side.a).height_m, Point(side.b).height_m, t) - dem_.HeightM(v)};
  }

  const Dem& dem_;
  const std::vector<std::uint8_t>& is_vertex_;
  const PostPlaces& places_;
  const PlacedMesh& mesh_;
  const MeshSides& sides_;
  Verticals verticals_;
  std::vector<float> errors_;  // per post, rounded up; kNotMet
  PostErrors result_;
};

}  // namespace

Result<PostErrors> MeasurePosts(const Terrain& terrain, const std::vector<std::uint8_t>& is_vertex,
                                const PostPlaces& places, const PlacedMesh& mesh,
                                const MeshSides& sides, const RunControl& control) {
  PostMeasurer measurer(terrain, is_vertex, places, mesh, sides);
  Status run = measurer.Run(control);
  if (!run) return std::move(run.error());
  return std::move(measurer).Take();
}

}  // namespace farhorizon
