#include "core/pipeline/post_normals.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace farhorizon {
namespace {

// Posts placed at a time: bounds the memory, whatever the level's size.
constexpr std::size_t kPostsAtATime = 1U << 16U;

// Some posts with all their neighbours, placed.
class Surroundings {
 public:
  static Result<Surroundings> Of(const Terrain& terrain, const Placement& placement,
                                 std::span<const VertexId> posts) {
    Surroundings result;
    for (const VertexId v : posts) {
      const Terrain::Neighbours neighbours = terrain.NeighboursOf(v);
      result.posts_.push_back(v);
      result.posts_.insert(result.posts_.end(), neighbours.begin(), neighbours.end());
    }
    std::sort(result.posts_.begin(), result.posts_.end());
    result.posts_.erase(std::unique(result.posts_.begin(), result.posts_.end()),
                        result.posts_.end());
    Result<std::vector<Enu>> points = placement.ToEnu(result.posts_);
    if (!points) return std::move(points.error());
    result.points_ = *std::move(points);
    return result;
  }

  [[nodiscard]] const Enu& At(VertexId v) const {
    const auto found = std::lower_bound(posts_.begin(), posts_.end(), v);
    Check(found != posts_.end() && *found == v, "a face's posts are neighbours");
    return points_[static_cast<std::size_t>(found - posts_.begin())];
  }

 private:
  std::vector<VertexId> posts_;
  std::vector<Enu> points_;
};

// Adds the triangle's normal, as long as twice its area.
void AddFace(const Enu& a, const Enu& b, const Enu& c, std::array<double, 3>& sum) {
  const std::array<double, 3> u = {b.east - a.east, b.north - a.north, b.up - a.up};
  const std::array<double, 3> v = {c.east - a.east, c.north - a.north, c.up - a.up};
  sum[0] += u[1] * v[2] - u[2] * v[1];
  sum[1] += u[2] * v[0] - u[0] * v[2];
  sum[2] += u[0] * v[1] - u[1] * v[0];
}

UnitNormal Raised(const std::array<double, 3>& sum) {
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  const UnitNormal normal = {sum[0] / length, sum[1] / length, sum[2] / length};
  if (normal[2] >= kLeastNormalUp) return normal;
  const double level = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1]);
  if (!(level > 0)) return {0, 0, 1};
  const double reach = std::sqrt(1 - kLeastNormalUp * kLeastNormalUp);
  return {reach * sum[0] / level, reach * sum[1] / level, kLeastNormalUp};
}

UnitNormal NormalAt(const Terrain& terrain, const Surroundings& around, VertexId post, bool keeps) {
  const std::int32_t column = terrain.dem().Column(post);
  const std::int32_t row = terrain.dem().Row(post);
  std::array<double, 3> sum = {0, 0, 0};
  for (std::int32_t r = std::max(row - 1, 0); r <= std::min(row, terrain.dem().rows - 2); ++r) {
    for (std::int32_t c = std::max(column - 1, 0); c <= std::min(column, terrain.dem().columns - 2);
         ++c) {
      const Terrain::CellTriangles cell = terrain.Cell(c, r);
      for (int i = 0; i < cell.count; ++i) {
        const Triangle& t = cell.triangles[static_cast<std::size_t>(i)];
        if (std::find(t.begin(), t.end(), post) == t.end()) continue;
        AddFace(around.At(t[0]), around.At(t[keeps ? 1 : 2]), around.At(t[keeps ? 2 : 1]), sum);
      }
    }
  }
  return Raised(sum);
}

}  // namespace

Result<std::vector<UnitNormal>> PostNormals(const Terrain& terrain, const Placement& placement,
                                            const std::vector<VertexId>& posts) {
  std::vector<UnitNormal> normals;
  normals.reserve(posts.size());
  const bool keeps = placement.KeepsOrientation();
  for (std::size_t first = 0; first < posts.size(); first += kPostsAtATime) {
    const std::span<const VertexId> some =
        std::span(posts).subspan(first, std::min(kPostsAtATime, posts.size() - first));
    Result<Surroundings> around = Surroundings::Of(terrain, placement, some);
    if (!around) return std::move(around.error());
    for (const VertexId post : some) {
      normals.push_back(NormalAt(terrain, *around, post, keeps));
    }
  }
  return normals;
}

}  // namespace farhorizon
