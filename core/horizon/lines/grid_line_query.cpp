// The terrain's edges lie on four families of grid lines (core/geometry/grid_lines.h). Along the
// line asked about, the crossings with each family are taken in turn, in pieces as long as a block
// of posts, from its starting point outwards: there the ground is likely to be high. A piece is
// skipped if no post of the blocks around it is higher than the highest edge found so far.
// Cost: a few additions for each grid line crossed.
#include "core/horizon/lines/grid_line_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/grid_lines.h"
#include "core/terrain/height_range.h"

namespace farhorizon {

namespace {

// A line that passes a post nearer than this, in posts, counts as through it.
//
// A line through a post must be found to pass it. The line crosses the rows or the columns at 45
// degrees or more. For these, i0 and j0 are coordinates, and j is the sum of two numbers below
// 2^16, one of them a product with a slope of 1 at most: so j is off by less than 3e-11, eight
// roundings of numbers below 2^15. Any value from there on is sound; this one changes the height of
// a crossing by 1e-9 of the difference between two neighbouring posts at most.
constexpr double kAtPost = 1e-9;
// Crossings with a family that is nearly parallel to the line are left out: they cannot be
// computed, as the error of i0 is divided by di, and they are not needed. Where the line crosses an
// edge of the family, both ends of the edge are within 2 |di| of the line, nearer than kAtPost. So
// other families find both ends, and one of the two is as high as the crossing. Any value well
// below kAtPost is sound.
constexpr double kAlongFamily = 1e-12;
// Bounds the error of the share at which an edge is crossed: kAtPost for a line that counts as
// through a post, less than a tenth of it for j and for the point that the line is given by, and
// less than that for the rounding of a height, which is below 2^31 quanta. The bound is twice their
// sum.
constexpr double kShareError = 0x1p-28;
// Blocks have 2^2 posts a side, and large blocks 2^4: any sizes are sound, these are fast. A piece
// of a line that is no longer than a block is wide, with its middle in the block, stays in the
// block and those around it, and so do the ends of the edges that it crosses.
constexpr int kBlockBits = 2;
constexpr int kLargeBlockBits = 4;
constexpr double kPiece = 1 << kBlockBits;
constexpr int kPiecesInLarge = 1 << (kLargeBlockBits - kBlockBits);

// One line, its points given by their distance from (x, y).
class LineWalk {
 public:
  LineWalk(const Terrain& terrain, bool has_holes, Edge except, const GridLineQuery::Line& line,
           double floor)
      : terrain_(terrain),
        has_holes_(has_holes),
        columns_(terrain.dem().columns),
        rows_(terrain.dem().rows),
        heights_(terrain.dem().heights.data()),
        except_(except),
        x_(line.x),
        y_(line.y),
        dx_(line.dx),
        dy_(line.dy),
        highest_{floor, {}} {
    Clip(x_, dx_, columns_ - 1);
    Clip(y_, dy_, rows_ - 1);
  }

  [[nodiscard]] double from() const { return from_; }
  [[nodiscard]] double to() const { return to_; }
  [[nodiscard]] const HighestEdge& highest() const { return highest_; }

  // The post at or before the line's point at a distance between from() and to().
  [[nodiscard]] Point2i PostAt(double distance) const {
    const auto column = static_cast<std::int32_t>(x_ + distance * dx_);
    const auto row = static_cast<std::int32_t>(y_ + distance * dy_);
    return {std::clamp(column, 0, columns_ - 1), std::clamp(row, 0, rows_ - 1)};
  }

  // Takes the crossings between two distances.
  void Walk(double from, double to) {
    const auto families = FamiliesOfGridLines(columns_, rows_);
    Walk(families[0], from, to);
    Walk(families[1], from, to);
    Walk(families[2], from, to);
    // The other diagonals are edges beside holes only.
    if (has_holes_) Walk(families[3], from, to);
  }

 private:
  // Narrows [from_, to_] to the distances at which the line is inside the grid.
  void Clip(double start, double step, double end) {
    if (step == 0) return;
    const double at_0 = -start / step;
    const double at_end = (end - start) / step;
    from_ = std::max(from_, std::min(at_0, at_end));
    to_ = std::min(to_, std::max(at_0, at_end));
  }

  // Inlined, so that each family is compiled with its constants: a quarter fewer instructions.
  [[gnu::always_inline]] void Walk(const GridLines& f, double from, double to) {
    const auto [i0, j0] = f.PositionOf(x_, y_);
    const auto [di, dj] = f.PositionOf(dx_, dy_);
    if (std::abs(di) < kAlongFamily) return;
    const double start = std::min(i0 + from * di, i0 + to * di);
    const double end = std::max(i0 + from * di, i0 + to * di);
    // A little more on either side: a crossing at the border of two pieces is found in one of them.
    const double begin = std::max<double>(f.first, std::ceil(start - kAtPost));
    const double past = std::min<double>(f.last, std::floor(end + kAtPost));
    const double slope = dj / di;
    const double limit = columns_ + rows_;
    for (auto i = static_cast<std::int32_t>(begin); i <= past; ++i) {
      const double j = j0 + (i - i0) * slope;
      if (j > -1 && j < limit) AddCrossing(f, i, j);
    }
  }

  // The crossing at j, above -1, of the family's line i.
  void AddCrossing(const GridLines& f, std::int32_t i, double j) {
    const std::int32_t whole = static_cast<std::int32_t>(j + 1) - 1;
    const double part = j - whole;
    if (part < kAtPost || part > 1 - kAtPost) {
      const std::int32_t at = part < kAtPost ? whole : whole + 1;
      AddPost(f.Post(i, at));
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

  // The edges at a post of the line.
  void AddPost(Point2i post) {
    if (!Inside(post.x, post.y)) return;
    const VertexId p = post.y * columns_ + post.x;
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
  HighestEdge highest_;
};

}  // namespace

GridLineQuery::GridLineQuery(const Terrain& terrain) : terrain_(terrain) {
  const Dem& dem = terrain.dem();
  const HeightRange range = HeightRangeOf(dem);
  height_error_ = kShareError * (static_cast<double>(range.greatest) - range.least);
  has_holes_ = std::find(dem.heights.begin(), dem.heights.end(), kNoHeight) != dem.heights.end();
  // kNoHeight is less than all.
  const BlockTops posts{dem.columns, dem.heights};
  const BlockTops blocks = posts.Coarser(kBlockBits);
  tops_ = blocks.OfNeighbourhoods();
  large_tops_ = blocks.Coarser(kLargeBlockBits - kBlockBits).OfNeighbourhoods();
}

GridLineQuery::BlockTops GridLineQuery::BlockTops::Coarser(int bits) const {
  const auto rows = static_cast<std::int32_t>(std::ssize(tops)) / columns;
  BlockTops coarser{((columns - 1) >> bits) + 1, {}};
  const std::int32_t coarser_rows = ((rows - 1) >> bits) + 1;
  coarser.tops.assign(
      static_cast<std::size_t>(coarser.columns) * static_cast<std::size_t>(coarser_rows),
      kNoHeight);
  for (std::int32_t row = 0; row < rows; ++row) {
    for (std::int32_t column = 0; column < columns; ++column) {
      std::int32_t& top = coarser.At(column >> bits, row >> bits);
      top = std::max(top, At(column, row));
    }
  }
  return coarser;
}

GridLineQuery::BlockTops GridLineQuery::BlockTops::OfNeighbourhoods() const {
  const auto rows = static_cast<std::int32_t>(std::ssize(tops)) / columns;
  BlockTops around = *this;
  for (std::int32_t row = 0; row < rows; ++row) {
    for (std::int32_t column = 0; column < columns; ++column) {
      std::int32_t& top = around.At(column, row);
      for (std::int32_t y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y) {
        for (std::int32_t x = std::max(column - 1, 0); x <= std::min(column + 1, columns - 1);
             ++x) {
          top = std::max(top, At(x, y));
        }
      }
    }
  }
  return around;
}

std::optional<HighestEdge> GridLineQuery::HighestEdgeOver(Edge except, const Line& line,
                                                          double floor) const {
  const double length = std::hypot(line.dx, line.dy);
  LineWalk walk(terrain_, has_holes_, except, {line.x, line.y, line.dx / length, line.dy / length},
                floor);
  // Large pieces begin at the line's point, as small ones do, with one half of each on either side
  // of the middle that names its block.
  const auto large_piece = [&](double from, double sense, double end) {
    const Point2i middle = walk.PostAt(std::min(from + kPiece * kPiecesInLarge / 2, end) * sense);
    if (large_tops_.At(middle.x >> kLargeBlockBits, middle.y >> kLargeBlockBits) <=
        walk.highest().height) {
      return;
    }
    // One at least: a line may touch the grid in one point.
    int pieces = 0;
    do {
      const double to = std::min(from + kPiece, end);
      const Point2i post = walk.PostAt((from + to) / 2 * sense);
      if (tops_.At(post.x >> kBlockBits, post.y >> kBlockBits) > walk.highest().height) {
        walk.Walk(from * sense, to * sense);
      }
      from += kPiece;
    } while (++pieces < kPiecesInLarge && from < end);
  };
  for (const double sense : {1.0, -1.0}) {
    const double end = std::max(sense > 0 ? walk.to() : -walk.from(), 0.0);
    double from = 0;
    do {
      large_piece(from, sense, end);
      from += kPiece * kPiecesInLarge;
    } while (from < end);
  }
  if (!(walk.highest().height > floor)) return std::nullopt;
  return walk.highest();
}

}  // namespace farhorizon
