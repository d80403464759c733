// Topology of a triangulated grid, read off from where data is missing. Cell() is the definition:
// the triangles of one cell. FacesOf and NeighboursOf have a shortcut for a post with data all
// around and otherwise follow from the triangles of the cells around. Cost: constant for each
// query.
#include "core/terrain/terrain.h"

#include <algorithm>

#include "core/geometry/plan.h"

namespace farhorizon {

namespace {

struct Offset {
  std::int32_t column;
  std::int32_t row;
};

// The eight posts around a post, clockwise on the map (rows downwards), starting east. Those with
// even numbers are joined to the post by a side of a cell, those with odd numbers lie across a cell
// from it.
//
//   5  6  7
//   4  o  0
//   3  2  1
constexpr std::array<Offset, 8> kAround = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

}  // namespace

Result<Terrain> Terrain::Build(const Dem& dem) {
  Check(dem.columns >= 1 && dem.rows >= 1 &&
            dem.heights.size() ==
                static_cast<std::size_t>(dem.columns) * static_cast<std::size_t>(dem.rows),
        "a DEM has a height for each of its posts");
  const Terrain terrain(dem);
  for (std::int32_t row = 0; row + 1 < dem.rows; ++row) {
    for (std::int32_t column = 0; column + 1 < dem.columns; ++column) {
      if (terrain.Cell(column, row).count > 0) return terrain;
    }
  }
  return Error{ErrorCode::kUnsupportedData,
               "no three neighbouring posts have data, so there is no surface; check the nodata "
               "value",
               "no-surface"};
}

bool Terrain::Has(std::int32_t column, std::int32_t row) const {
  return column >= 0 && column < dem_->columns && row >= 0 && row < dem_->rows &&
         dem_->HasData(row * dem_->columns + column);
}

bool Terrain::IsSurrounded(std::int32_t column, std::int32_t row) const {
  if (column < 1 || column + 1 >= dem_->columns || row < 1 || row + 1 >= dem_->rows) return false;
  const std::int32_t* middle =
      dem_->heights.data() + static_cast<std::ptrdiff_t>(row) * dem_->columns + column;
  for (const std::int32_t* of_row : {middle - dem_->columns, middle, middle + dem_->columns}) {
    if (of_row[-1] == kNoHeight || of_row[0] == kNoHeight || of_row[1] == kNoHeight) return false;
  }
  return true;
}

Terrain::CellTriangles Terrain::Cell(std::int32_t column, std::int32_t row) const {
  const VertexId nw = row * dem_->columns + column;
  const VertexId ne = nw + 1;
  const VertexId sw = nw + dem_->columns;
  const VertexId se = sw + 1;
  const bool has_nw = dem_->HasData(nw);
  const bool has_ne = dem_->HasData(ne);
  const bool has_sw = dem_->HasData(sw);
  const bool has_se = dem_->HasData(se);
  CellTriangles cell;
  const auto add = [&cell](VertexId a, VertexId b, VertexId c) {
    cell.triangles[static_cast<std::size_t>(cell.count++)] = {a, b, c};
  };
  if (has_nw && has_se) {
    if (has_ne) add(nw, se, ne);
    if (has_sw) add(nw, sw, se);
  } else if (has_ne && has_sw) {
    if (has_nw) add(nw, sw, ne);
    if (has_se) add(ne, sw, se);
  }
  return cell;
}

Terrain::Faces Terrain::FacesOf(Edge edge) const {
  const std::int32_t column = dem_->Column(edge.a);
  const std::int32_t row = dem_->Row(edge.a);
  if (IsSurrounded(column, row)) {
    const VertexId a = edge.a;
    const std::int32_t columns = dem_->columns;
    const std::int32_t step = edge.b - a;
    if (step == 1) return {a - columns, a + columns + 1};
    if (step == columns) return {a + columns + 1, a - 1};
    if (step == columns + 1) return {a + 1, a + columns};
  }
  return FacesInCells(edge);
}

Terrain::Faces Terrain::FacesInCells(Edge edge) const {
  Faces faces;
  const std::int32_t column = dem_->Column(edge.a);
  const std::int32_t row = dem_->Row(edge.a);
  // An edge lies in the one or two cells that have both its posts as corners.
  for (std::int32_t r = std::max(row - 1, 0); r <= std::min(row, dem_->rows - 2); ++r) {
    for (std::int32_t c = std::max(column - 1, 0); c <= std::min(column, dem_->columns - 2); ++c) {
      const CellTriangles cell = Cell(c, r);
      for (int i = 0; i < cell.count; ++i) {
        const Triangle& t = cell.triangles[static_cast<std::size_t>(i)];
        for (std::size_t k = 0; k < 3; ++k) {
          const VertexId from = t[k];
          const VertexId to = t[(k + 1) % 3];
          // Triangles run counter-clockwise, so their third post is on the left of each side.
          if (from == edge.a && to == edge.b) faces.left = t[(k + 2) % 3];
          if (from == edge.b && to == edge.a) faces.right = t[(k + 2) % 3];
        }
      }
    }
  }
  return faces;
}

Terrain::Neighbours Terrain::NeighboursOf(VertexId v) const {
  Neighbours neighbours;
  if (!dem_->HasData(v)) return neighbours;
  const std::int32_t column = dem_->Column(v);
  const std::int32_t row = dem_->Row(v);
  if (IsSurrounded(column, row)) {
    const std::int32_t columns = dem_->columns;
    return {{v + 1, v + columns + 1, v + columns, v - 1, v - columns - 1, v - columns}, 6};
  }
  std::array<bool, 8> present{};
  for (std::size_t i = 0; i < 8; ++i) {
    present[i] = Has(column + kAround[i].column, row + kAround[i].row);
  }
  std::array<bool, 8> joined{};
  // Each cell around the post has two of its straight neighbours as corners, and one post across.
  // The cell's diagonal runs through the post itself in the south-east (1) and the north-west (5)
  // cell.
  for (std::size_t straight = 0; straight < 8; straight += 2) {
    const std::size_t across = straight + 1;
    const std::size_t next = (straight + 2) % 8;
    const bool split_here = across == 1 || across == 5;
    if (present[straight] && present[next] && (!present[across] || !split_here)) {
      // One triangle has the post and both straight neighbours: the post across is missing or cut
      // off.
      joined[straight] = joined[next] = true;
    }
    if (!present[across]) continue;
    if (split_here) {
      joined[straight] = joined[straight] || present[straight];
      joined[next] = joined[next] || present[next];
      joined[across] = joined[across] || present[straight] || present[next];
    } else if (present[straight] != present[next]) {
      // The post, one straight neighbour and the post across: a triangle only where the other
      // straight neighbour is missing.
      joined[across] = true;
      joined[present[straight] ? straight : next] = true;
    }
  }
  for (std::size_t i = 0; i < 8; ++i) {
    if (joined[i]) {
      neighbours.posts[static_cast<std::size_t>(neighbours.count++)] =
          v + kAround[i].row * dem_->columns + kAround[i].column;
    }
  }
  return neighbours;
}

bool Terrain::IsRidgeOrBorder(Edge edge, const Faces& faces) const {
  return !faces.left || !faces.right ||
         RidgeSign(Point(edge.a), Point(edge.b), Point(*faces.left), Point(*faces.right)) > 0;
}

std::vector<Edge> Terrain::Edges() const {
  std::vector<Edge> edges;
  edges.reserve(static_cast<std::size_t>(post_count()) * 3);
  for (VertexId v = 0; v < post_count(); ++v) {
    const std::size_t first = edges.size();
    for (const VertexId n : NeighboursOf(v)) {
      if (n > v) edges.push_back({v, n});
    }
    std::sort(edges.begin() + static_cast<std::ptrdiff_t>(first), edges.end());
  }
  return edges;
}

std::int64_t Terrain::CountEdges() const {
  std::int64_t twice = 0;
  for (VertexId v = 0; v < post_count(); ++v) twice += NeighboursOf(v).count;
  return twice / 2;
}

std::vector<Triangle> Terrain::Triangles() const {
  std::vector<Triangle> triangles;
  for (std::int32_t row = 0; row + 1 < dem_->rows; ++row) {
    for (std::int32_t column = 0; column + 1 < dem_->columns; ++column) {
      const CellTriangles cell = Cell(column, row);
      for (int i = 0; i < cell.count; ++i) {
        triangles.push_back(cell.triangles[static_cast<std::size_t>(i)]);
      }
    }
  }
  return triangles;
}

}  // namespace farhorizon
