// Normals of posts from a band of two rows of them, each placed once; normals of vertices from the
// posts that their triangles cover. Sums run in the order of posts and of triangles, so that the
// bytes are the same every time.
#include "core/pipeline/post_normals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/row_span.h"
#include "core/io/draco_mesh.h"

namespace farhorizon {

namespace {

// A row of posts in the local frame; those without data are at the origin.
Result<std::vector<Enu>> PlaceRow(const Terrain& terrain, const Georeference& georeference,
                                  std::int32_t row) {
  const std::int32_t columns = terrain.dem().columns;
  std::vector<VertexId> posts;
  for (VertexId v = row * columns; v < (row + 1) * columns; ++v) {
    if (terrain.dem().HasData(v)) posts.push_back(v);
  }
  Result<std::vector<Enu>> points = georeference.ToEnu(posts);
  if (!points) return points;
  std::vector<Enu> result(static_cast<std::size_t>(columns));
  for (std::size_t i = 0; i < posts.size(); ++i) {
    result[static_cast<std::size_t>(terrain.dem().Column(posts[i]))] = (*points)[i];
  }
  return result;
}

using Sums = std::vector<std::array<double, 3>>;

// `sum` at length 1, its `up` raised to kLeastNormalUp where it is below.
UnitNormal Raised(const std::array<double, 3>& sum) {
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  const UnitNormal normal = {sum[0] / length, sum[1] / length, sum[2] / length};
  if (normal[2] >= kLeastNormalUp) return normal;
  const double horizontal = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1]);
  if (!(horizontal > 0)) return {0, 0, 1};
  const double reach = std::sqrt(1 - kLeastNormalUp * kLeastNormalUp);
  return {reach * sum[0] / horizontal, reach * sum[1] / horizontal, kLeastNormalUp};
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

void AppendRow(const Sums& sums, PostNormals& normals) {
  for (const std::array<double, 3>& sum : sums) {
    const bool vertex = sum != std::array<double, 3>{0, 0, 0};
    const UnitNormal n = vertex ? Raised(sum) : UnitNormal{0, 0, 0};
    normals.push_back(
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

}  // namespace

Result<PostNormals> FindPostNormals(const Terrain& terrain, const Georeference& georeference) {
  const Dem& dem = terrain.dem();
  PostNormals normals;
  normals.reserve(dem.heights.size());
  const Sums none(static_cast<std::size_t>(dem.columns), {0, 0, 0});
  Band band;
  band.sums = {none, none};
  Result<std::vector<Enu>> first = PlaceRow(terrain, georeference, 0);
  if (!first) return std::move(first.error());
  band.points[0] = *std::move(first);
  for (std::int32_t row = 0; row + 1 < dem.rows; ++row) {
    Result<std::vector<Enu>> next = PlaceRow(terrain, georeference, row + 1);
    if (!next) return std::move(next.error());
    band.points[1] = *std::move(next);
    AddFaces(terrain, georeference.KeepsOrientation(), row, band);
    AppendRow(band.sums[0], normals);
    band.points[0].swap(band.points[1]);
    band.sums[0].swap(band.sums[1]);
    band.sums[1] = none;
  }
  AppendRow(band.sums[0], normals);
  return normals;
}

std::vector<UnitNormal> MeanNormals(const Terrain& terrain, const PostNormals& normals,
                                    const LocalMesh& mesh) {
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
        const auto post = static_cast<std::size_t>(row * terrain.dem().columns + column);
        AddPost(normals[post], SharesOf(plan, column, row), here);
      }
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (std::size_t k = 0; k < 3; ++k) sums[slot[t[corner]]][k] += here[corner][k];
    }
  }
  std::vector<UnitNormal> result;
  result.reserve(mesh.posts.size());
  for (const std::size_t s : slot) result.push_back(Raised(sums[s]));
  return result;
}

}  // namespace farhorizon
