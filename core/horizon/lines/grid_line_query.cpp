#include "core/horizon/lines/grid_line_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/grid_lines.h"

namespace farhorizon {
namespace {

// Nearer to a post than this, the line goes through it: far more than what rounding does.
constexpr double kAtPost = 1e-9;
// Blocks have 2^3 posts a side. A piece of a line whose middle is in a block, and that is no longer than the
// block is wide, stays within the block and its neighbours, and so do the posts beside it.
constexpr int kBlockBits = 3;
constexpr double kPiece = 1 << kBlockBits;

// One line, by its distance from (x, y).
class Walker {
 public:
  Walker(const Terrain& terrain, bool has_holes, Edge except, double x, double y, double dx,
         double dy)
      : terrain_(terrain),
        has_holes_(has_holes),
        columns_(terrain.dem().columns),
        rows_(terrain.dem().rows),
        heights_(terrain.dem().heights.data()),
        except_(except),
        x_(x),
        y_(y),
        dx_(dx),
        dy_(dy) {
    Clip(x, dx, columns_ - 1);
    Clip(y, dy, rows_ - 1);
  }

  [[nodiscard]] double from() const { return from_; }
  [[nodiscard]] double to() const { return to_; }
  [[nodiscard]] const HighestEdge& highest() const { return highest_; }

  // The block that the line is in at a distance between from() and to().
  [[nodiscard]] std::pair<std::int32_t, std::int32_t> BlockAt(double distance) const {
    const auto column = static_cast<std::int32_t>(x_ + distance * dx_);
    const auto row = static_cast<std::int32_t>(y_ + distance * dy_);
    return {std::clamp(column, 0, columns_ - 1) >> kBlockBits,
            std::clamp(row, 0, rows_ - 1) >> kBlockBits};
  }

  void Walk(double from, double to) {
    const auto families = FamiliesOfGridLines(columns_, rows_);
    // The other diagonals are edges beside holes only.
    for (std::size_t k = 0; k < (has_holes_ ? 4 : 3); ++k) Walk(families[k], from, to);
  }

 private:
  // Narrows [from_, to_], where the line is above the grid.
  void Clip(double start, double step, double end) {
    if (step == 0) return;
    const double at_0 = -start / step;
    const double at_end = (end - start) / step;
    from_ = std::max(from_, std::min(at_0, at_end));
    to_ = std::min(to_, std::max(at_0, at_end));
  }

  void Walk(const GridLines& f, double from, double to) {
    const auto [i0, j0] = f.PositionOf(x_, y_);
    const auto [di, dj] = f.PositionOf(dx_, dy_);
    if (std::abs(di) < 1e-12) return;  // along the family: met by the others
    const double start = std::min(i0 + from * di, i0 + to * di);
    const double end = std::max(i0 + from * di, i0 + to * di);
    // A little more on either side, for what rounding does.
    const double begin = std::max<double>(f.first, std::ceil(start - kAtPost));
    const double past = std::min<double>(f.last, std::floor(end + kAtPost));
    const double slope = dj / di;
    const double limit = columns_ + rows_;
    for (auto i = static_cast<std::int32_t>(begin); i <= past; ++i) {
      const double j = j0 + (i - i0) * slope;
      if (j > -1 && j < limit) AddObstacle(f, i, j);
    }
  }

  // j > -1.
  void AddObstacle(const GridLines& f, std::int32_t i, double j) {
    const std::int32_t whole = static_cast<std::int32_t>(j + 1) - 1;
    const double part = j - whole;
    if (part < kAtPost || part > 1 - kAtPost) {
      const std::int32_t at = part < kAtPost ? whole : whole + 1;
      MeetPost(f.Post(i, at));
      return;
    }
    const auto [column, row] = f.Post(i, whole);
    if (!Inside(column, row) || !Inside(column + f.along_column, row + f.along_row)) return;
    const VertexId p = row * columns_ + column;
    const VertexId q = p + f.along_row * columns_ + f.along_column;
    const double low = heights_[p];
    const double high = heights_[q];
    const double height = low + part * (high - low);
    if (height <= highest_.height || low == kNoHeight || high == kNoHeight) return;
    const Edge edge = MakeEdge(p, q);
    if (edge == except_) return;
    const Terrain::Faces faces = terrain_.FacesOf(edge);
    if (faces.left || faces.right) highest_ = {height, edge};
  }

  void MeetPost(Point2i post) {
    const auto [column, row] = post;
    if (!Inside(column, row)) return;
    const VertexId p = row * columns_ + column;
    if (heights_[p] <= highest_.height || heights_[p] == kNoHeight) return;
    for (const VertexId neighbour : terrain_.NeighboursOf(p)) {
      const Edge edge = MakeEdge(p, neighbour);
      if (!(edge == except_)) highest_ = {static_cast<double>(heights_[p]), edge};
    }
  }

  [[nodiscard]] bool Inside(std::int32_t column, std::int32_t row) const {
    return column >= 0 && column < columns_ && row >= 0 && row < rows_;
  }

  const Terrain& terrain_;
  bool has_holes_;
  std::int32_t columns_;
  std::int32_t rows_;
  const std::int32_t* heights_;
  Edge except_;
  double x_;
  double y_;
  double dx_;
  double dy_;
  double from_ = -std::numeric_limits<double>::infinity();
  double to_ = std::numeric_limits<double>::infinity();
  HighestEdge highest_{-std::numeric_limits<double>::infinity(), {}};
};

}  // namespace

GridLineQuery::GridLineQuery(const Terrain& terrain) : terrain_(terrain) {
  const Dem& dem = terrain.dem();
  block_columns_ = ((dem.columns - 1) >> kBlockBits) + 1;
  const std::int32_t block_rows = ((dem.rows - 1) >> kBlockBits) + 1;
  tops_.assign(static_cast<std::size_t>(block_columns_) * static_cast<std::size_t>(block_rows),
               kNoHeight);
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    const std::int32_t height = dem.heights[static_cast<std::size_t>(v)];
    if (height == kNoHeight) has_holes_ = true;
    const std::int32_t column = dem.Column(v) >> kBlockBits;
    const std::int32_t row = dem.Row(v) >> kBlockBits;
    // kNoHeight is less than all.
    for (std::int32_t y = std::max(row - 1, 0); y <= std::min(row + 1, block_rows - 1); ++y) {
      for (std::int32_t x = std::max(column - 1, 0); x <= std::min(column + 1, block_columns_ - 1);
           ++x) {
        std::int32_t& top = tops_[static_cast<std::size_t>(y * block_columns_ + x)];
        top = std::max(top, height);
      }
    }
  }
}

std::optional<HighestEdge> GridLineQuery::HighestEdgeOver(Edge except, double x, double y,
                                                          double dx, double dy) const {
  const double length = std::hypot(dx, dy);
  Walker walker(terrain_, has_holes_, except, x, y, dx / length, dy / length);
  const auto walk = [&](double from, double to) {
    const auto [column, row] = walker.BlockAt((from + to) / 2);
    const std::int32_t top = tops_[static_cast<std::size_t>(row * block_columns_ + column)];
    if (top > walker.highest().height) walker.Walk(from, to);
  };
  // From the edge outwards: what is highest is likely to be near.
  double from = 0;
  do {
    walk(from, std::min(from + kPiece, walker.to()));
    from += kPiece;
  } while (from < walker.to());
  for (double to = 0; to > walker.from(); to -= kPiece) {
    walk(std::max(to - kPiece, walker.from()), to);
  }
  if (!std::isfinite(walker.highest().height)) return std::nullopt;
  return walker.highest();
}

}  // namespace farhorizon
