// Normals of posts from a band of two rows of them, each placed once; normals of vertices from the
// posts that their triangles cover. Sums run in the order of posts and of triangles, so that the
// bytes are the same every time.
#include "core/pipeline/post_normals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geo/ellipsoid_normal.h"
#include "core/geometry/row_span.h"
#include "core/io/draco_mesh.h"
#include "core/terrain/border.h"

namespace farhorizon {

namespace {

// The ground around a tile and how to place it.
struct Surroundings {
  const Terrain& around;
  const Georeference& georeference;  // of the tile
  int apron;
};

// A row of posts in the local frame; those without data are at the origin.
Result<std::vector<Enu>> PlaceRow(const Surroundings& ground, std::int32_t row) {
  const Dem& dem = ground.around.dem();
  std::vector<GridPoint> posts;  // in the tile's grid
  std::vector<std::size_t> columns;
  for (std::int32_t column = 0; column < dem.columns; ++column) {
    const VertexId v = row * dem.columns + column;
    if (!dem.HasData(v)) continue;
    posts.push_back({static_cast<double>(column - ground.apron),
                     static_cast<double>(row - ground.apron), dem.HeightM(v)});
    columns.push_back(static_cast<std::size_t>(column));
  }
  Result<std::vector<Geodetic>> geodetic = ground.georeference.ToGeodetic(posts);
  if (!geodetic) return std::move(geodetic.error());
  Result<std::vector<Enu>> points = ground.georeference.ToEnu(*geodetic);
  if (!points) return points;
  std::vector<Enu> result(static_cast<std::size_t>(dem.columns));
  for (std::size_t i = 0; i < columns.size(); ++i) result[columns[i]] = (*points)[i];
  return result;
}

using Sums = std::vector<std::array<double, 3>>;

double Dot(const UnitNormal& a, const UnitNormal& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

UnitNormal OfLengthOne(const std::array<double, 3>& v) {
  const double length = std::sqrt(Dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

// `sum`, at `p`, at length 1, raised to kLeastNormalUp where it points upwards by less.
UnitNormal Raised(const std::array<double, 3>& sum, const Enu& p, const TangentFrame& frame) {
  const UnitNormal normal = OfLengthOne(sum);
  const Enu upwards = EllipsoidNormal(p, frame);
  const UnitNormal up = OfLengthOne({upwards.east, upwards.north, upwards.up});
  const double rise = Dot(normal, up);
  if (rise >= kLeastNormalUp) return normal;
  const UnitNormal level = {normal[0] - rise * up[0], normal[1] - rise * up[1],
                            normal[2] - rise * up[2]};
  if (!(Dot(level, level) > 0)) return up;
  const UnitNormal ahead = OfLengthOne(level);
  const double reach = std::sqrt(1 - kLeastNormalUp * kLeastNormalUp);
  UnitNormal raised{};
  for (std::size_t k = 0; k < 3; ++k) raised[k] = reach * ahead[k] + kLeastNormalUp * up[k];
  return raised;
}

// Two neighbouring rows of posts and the sums of their faces' normals so far.
struct Band {
  std::array<std::vector<Enu>, 2> points;
  std::array<Sums, 2> sums;
};

// Adds the normals of the faces between rows `row` and `row + 1` to their corners' sums.
void AddFaces(const Terrain& terrain, bool keeps, std::int32_t row, Band& band) {
  const Dem& dem = terrain.dem();
  const auto of = [&](auto& rows, VertexId v) -> auto& {
    return rows[static_cast<std::size_t>(dem.Row(v) - row)]
               [static_cast<std::size_t>(dem.Column(v))];
  };
  for (std::int32_t column = 0; column + 1 < dem.columns; ++column) {
    const Terrain::CellTriangles cell = terrain.Cell(column, row);
    for (int i = 0; i < cell.count; ++i) {
      const Triangle& t = cell.triangles[static_cast<std::size_t>(i)];
      const std::array<double, 3> normal =
          FaceNormal(of(band.points, t[0]), of(band.points, t[keeps ? 1 : 2]),
                     of(band.points, t[keeps ? 2 : 1]));
      for (const VertexId v : t) {
        for (std::size_t k = 0; k < 3; ++k) of(band.sums, v)[k] += normal[k];
      }
    }
  }
}

// Appends the normals of the band's first row.
void AppendRow(const Band& band, const TangentFrame& frame, PostNormals& normals) {
  for (std::size_t i = 0; i < band.sums[0].size(); ++i) {
    const std::array<double, 3>& sum = band.sums[0][i];
    const bool vertex = sum != std::array<double, 3>{0, 0, 0};
    const UnitNormal n = vertex ? Raised(sum, band.points[0][i], frame) : UnitNormal{0, 0, 0};
    normals.around.push_back(
        {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
  }
}

// The barycentric coordinates of post (column, row), which is inside the triangle.
std::array<double, 3> SharesOf(const std::array<Point3i, 3>& plan, std::int64_t column,
                               std::int64_t row) {
  std::array<std::int64_t, 3> areas{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point3i& p = plan[(k + 1) % 3];
    const Point3i& q = plan[(k + 2) % 3];
    areas[k] = (p.x - column) * (q.y - row) - (p.y - row) * (q.x - column);
  }
  const auto whole = static_cast<double>(areas[0] + areas[1] + areas[2]);
  return {static_cast<double>(areas[0]) / whole, static_cast<double>(areas[1]) / whole,
          static_cast<double>(areas[2]) / whole};
}

// The part of a post that counts for the triangle: half on a side, a sixth at a corner, as where
// six triangles of a plain grid meet.
double PartOf(const std::array<double, 3>& shares) {
  const auto zeros = std::count(shares.begin(), shares.end(), 0.0);
  return zeros == 0 ? 1 : zeros == 1 ? 0.5 : 1.0 / 6;
}

// Adds one post's normal to the sums of a triangle's corners.
void AddPost(const std::array<float, 3>& normal, const std::array<double, 3>& shares,
             std::array<std::array<double, 3>, 3>& sums) {
  const double part = PartOf(shares);
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const double weight = part * shares[corner] * shares[corner];
    for (std::size_t k = 0; k < 3; ++k) sums[corner][k] += weight * normal[k];
  }
}

// The sum of normals around a post on a side, by weights that fall linearly with the distance.
std::array<double, 3> SeamSum(const PostNormals& normals, std::int64_t column, std::int64_t row,
                              int reach) {
  std::array<double, 3> sum = {0, 0, 0};
  for (int r = -reach; r <= reach; ++r) {
    for (int c = -reach; c <= reach; ++c) {
      const double weight = double{1} * (reach + 1 - std::abs(c)) * (reach + 1 - std::abs(r));
      const std::array<float, 3>& normal = normals.At(column + c, row + r);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * normal[k];
    }
  }
  return sum;
}

}  // namespace

int SeamReach(int apron, int coarseness) {
  return static_cast<int>(
      std::min<double>(std::max(apron - 1, 0), std::round(1.1 * std::pow(2.5, coarseness / 2.0))));
}

Result<PostNormals> FindPostNormals(const Terrain& around, const Georeference& georeference,
                                    int apron) {
  const Dem& dem = around.dem();
  const Surroundings ground = {around, georeference, apron};
  PostNormals normals = {apron, dem.columns, {}};
  normals.around.reserve(dem.heights.size());
  const Sums none(static_cast<std::size_t>(dem.columns), {0, 0, 0});
  Band band;
  band.sums = {none, none};
  Result<std::vector<Enu>> first = PlaceRow(ground, 0);
  if (!first) return std::move(first.error());
  band.points[0] = *std::move(first);
  for (std::int32_t row = 0; row + 1 < dem.rows; ++row) {
    Result<std::vector<Enu>> next = PlaceRow(ground, row + 1);
    if (!next) return std::move(next.error());
    band.points[1] = *std::move(next);
    AddFaces(around, georeference.KeepsOrientation(), row, band);
    AppendRow(band, georeference.frame(), normals);
    band.points[0].swap(band.points[1]);
    band.sums[0].swap(band.sums[1]);
    band.sums[1] = none;
  }
  AppendRow(band, georeference.frame(), normals);
  return normals;
}

std::vector<UnitNormal> MeanNormals(const Terrain& terrain, const TangentFrame& frame,
                                    const PostNormals& normals, const LocalMesh& mesh,
                                    int seam_reach) {
  // Vertices of one post share a slot.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> by_post = VerticesByPost(mesh);
  std::vector<std::size_t> slot(mesh.posts.size());
  std::size_t slots = 0;
  for (std::size_t i = 0; i < by_post.size(); ++i) {
    if (i > 0 && by_post[i].first != by_post[i - 1].first) ++slots;
    slot[by_post[i].second] = slots;
  }
  Sums sums(slots + 1, {0, 0, 0});
  for (const auto& t : mesh.triangles) {
    std::array<Point3i, 3> plan{};
    for (std::size_t k = 0; k < 3; ++k) {
      plan[k] = terrain.Point(static_cast<VertexId>(mesh.posts[t[k]]));
    }
    std::array<std::array<double, 3>, 3> here{};
    const auto [top, bottom] = std::minmax({plan[0].y, plan[1].y, plan[2].y});
    for (std::int64_t row = top; row <= bottom; ++row) {
      const RowSpan span = SpanOfRow(plan, row);
      for (std::int64_t column = span.first; column <= span.last; ++column) {
        AddPost(normals.At(column, row), SharesOf(plan, column, row), here);
      }
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (std::size_t k = 0; k < 3; ++k) sums[slot[t[corner]]][k] += here[corner][k];
    }
  }
  std::vector<UnitNormal> result;
  result.reserve(mesh.posts.size());
  const Dem& dem = terrain.dem();
  for (std::size_t i = 0; i < slot.size(); ++i) {
    const auto post = static_cast<VertexId>(mesh.posts[i]);
    const std::array<double, 3> sum =
        normals.apron > 0 && OnSide(dem, post)
            ? SeamSum(normals, dem.Column(post), dem.Row(post), seam_reach)
            : sums[slot[i]];
    result.push_back(Raised(sum, mesh.positions[i], frame));
  }
  return result;
}

}  // namespace farhorizon
