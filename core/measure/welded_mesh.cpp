#include "core/measure/welded_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

namespace farhorizon {

namespace {

Status CheckPoints(const PlacedMesh& mesh) {
  const GridMesh& grid = mesh.grid;
  if (!mesh.straight.empty() && mesh.straight.size() != grid.points.size()) {
    return Error{ErrorCode::kUnsupportedData,
                 "the mesh has " + std::to_string(grid.points.size()) + " points, of which " +
                     std::to_string(mesh.straight.size()) + " are placed",
                 "bad-mesh"};
  }
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    const GridPoint& p = grid.points[i];
    const bool placed =
        mesh.straight.empty() || std::all_of(mesh.straight[i].begin(), mesh.straight[i].end(),
                                             [](double x) { return std::isfinite(x); });
    if (std::isfinite(p.column) && std::isfinite(p.row) && std::isfinite(p.height_m) && placed) {
      continue;
    }
    return Error{ErrorCode::kUnsupportedData, "point " + std::to_string(i) + " is not finite",
                 "bad-mesh"};
  }
  const auto count = static_cast<std::int32_t>(grid.points.size());
  for (const std::array<std::int32_t, 3>& t : grid.triangles) {
    if (std::any_of(t.begin(), t.end(), [&](std::int32_t i) { return i < 0 || i >= count; })) {
      return Error{ErrorCode::kUnsupportedData,
                   "a triangle names a point that the mesh does not have", "unknown-point"};
    }
  }
  return Ok{};
}

}  // namespace

Result<PlacedMesh> WeldedMesh(const PlacedMesh& mesh) {
  Status good = CheckPoints(mesh);
  if (!good) return std::move(good.error());
  const std::vector<GridPoint>& points = mesh.grid.points;
  const auto key = [&points](std::size_t i) {
    return std::tie(points[i].column, points[i].row, points[i].height_m);
  };
  std::vector<std::int32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t j) {
    const auto of_i = key(static_cast<std::size_t>(i));
    const auto of_j = key(static_cast<std::size_t>(j));
    return of_i < of_j || (of_i == of_j && i < j);
  });
  // Of equal points the first one stands for all.
  std::vector<std::int32_t> stands_for(points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto at = static_cast<std::size_t>(order[k]);
    const bool same = k > 0 && key(static_cast<std::size_t>(order[k - 1])) == key(at);
    stands_for[at] = same ? stands_for[static_cast<std::size_t>(order[k - 1])] : order[k];
  }
  PlacedMesh welded;
  welded.grid.points = points;
  welded.straight = mesh.straight;
  welded.grid.triangles.reserve(mesh.grid.triangles.size());
  for (std::array<std::int32_t, 3> t : mesh.grid.triangles) {
    for (std::int32_t& i : t) i = stands_for[static_cast<std::size_t>(i)];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    welded.grid.triangles.push_back(t);
  }
  return welded;
}

}  // namespace farhorizon
