// The mesh of all triangles of a terrain. Twins are found row of cells by row of cells: an edge of
// the grid has one of eight directions, so a table of eight half-edges for each post of two rows
// knows all that later triangles can meet.
#include <array>

#include "core/simplify/mesh/half_edge_mesh.h"

namespace farhorizon {

namespace {

// Half-edges by where they start and in which of the eight directions they go, for two rows.
class OpenEdges {
 public:
  explicit OpenEdges(std::int32_t columns)
      : columns_(columns), edges_(2 * kDirections * columns, HalfEdgeMesh::kNone) {}

  std::int32_t& From(std::int32_t v, std::int32_t w) {
    const std::int32_t dx = w % columns_ - v % columns_;
    const std::int32_t dy = w / columns_ - v / columns_;
    return edges_[(v / columns_ % 2 * columns_ + v % columns_) * kDirections + 3 * (dy + 1) + dx +
                  1];
  }
  void ForgetRow(std::int32_t row) {
    const std::int32_t first = row % 2 * columns_ * kDirections;
    for (std::int32_t i = 0; i < columns_ * kDirections; ++i) {
      edges_[first + i] = HalfEdgeMesh::kNone;
    }
  }

 private:
  static constexpr std::int32_t kDirections = 9;  // one of them is none

  std::int32_t columns_;
  Table<std::int32_t> edges_;
};

}  // namespace

HalfEdgeMesh::HalfEdgeMesh(const Ground& ground) : ground_(&ground) {
  const Terrain& terrain = ground.terrain();
  const Dem& dem = terrain.dem();
  const std::int64_t most = 6 * std::int64_t{dem.columns - 1} * (dem.rows - 1);
  origin_.reserve(most);
  twin_.reserve(most);
  at_.resize(terrain.post_count());
  out_.resize(terrain.post_count(), kNone);
  degree_.resize(terrain.post_count(), 0);
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (dem.HasData(v)) at_[v] = ground.At(v);
  }
  OpenEdges open(dem.columns);
  for (std::int32_t row = 0; row + 1 < dem.rows; ++row) {
    open.ForgetRow(row + 1);
    for (std::int32_t column = 0; column + 1 < dem.columns; ++column) {
      const Terrain::CellTriangles cell = terrain.Cell(column, row);
      for (std::int32_t i = 0; i < cell.count; ++i) {
        // A terrain's triangles turn the other way, as its plan has rows downwards.
        const Triangle& t = cell.triangles[static_cast<std::size_t>(i)];
        const std::int32_t h = origin_.size();
        for (const VertexId v : {t[0], t[2], t[1]}) {
          origin_.push_back(v);
          twin_.push_back(kNone);
        }
        for (std::int32_t k = h; k < h + 3; ++k) {
          const VertexId from = origin_[k];
          const VertexId to = origin_[Next(k)];
          const std::int32_t opposite = open.From(to, from);
          if (opposite != kNone) SetTwins(k, opposite);
          open.From(from, to) = k;
        }
      }
    }
  }
  triangles_ = origin_.size() / 3;
  squares_.resize(triangles_, 0);  // every post is at a corner of its triangles
  MarkKnots();
}

void HalfEdgeMesh::MarkKnots() {
  // A rim's half-edge leaves a vertex once for each fan; more than one fan is a knot.
  for (std::int32_t h = 0; h < half_edges(); ++h) {
    const std::int32_t v = origin_[h];
    const bool rim = twin_[h] == kNone;
    const bool had_rim = out_[v] != kNone && twin_[out_[v]] == kNone;
    if (degree_[v] != kKnotted) {
      degree_[v] = rim && had_rim ? kKnotted : static_cast<std::uint8_t>(degree_[v] + 1);
    }
    if (rim || out_[v] == kNone) out_[v] = h;
    const std::int32_t end = origin_[Next(h)];
    if (rim && degree_[end] != kKnotted) ++degree_[end];
  }
}

}  // namespace farhorizon
