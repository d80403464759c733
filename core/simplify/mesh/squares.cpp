// Row by row of the posts under a triangle: the plane's height where the row begins, and a step for
// each column. The ground's gradients are differences of the posts at hand, so that neither they
// nor planes of the ground's facets are stored.
#include "core/simplify/mesh/squares.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/simplify/mesh/triangle_rows.h"

namespace farhorizon {

namespace {

// Of a cell's weight: it has two facets.
constexpr float kOfAFacet = 0.5F;

// The plane through three places: height and its change by columns and rows.
struct Plane {
  Plane(const Place& a, const Place& b, const Place& c) {
    inverse = 1.0F / static_cast<float>(Turn(a, b, c));
    const auto bx = static_cast<float>(b.x - a.x);
    const auto by = static_cast<float>(b.y - a.y);
    const auto cx = static_cast<float>(c.x - a.x);
    const auto cy = static_cast<float>(c.y - a.y);
    const float bz = b.frame - a.frame;
    const float cz = c.frame - a.frame;
    by_column = (bz * cy - cz * by) * inverse;
    by_row = (cz * bx - bz * cx) * inverse;
  }
  float inverse;
  float by_column;
  float by_row;
};

// The gradients of the ground's facets of a row of cells, by the upper row of posts.
class FacetRow {
 public:
  FacetRow(const Ground& ground, std::int32_t row)
      : above_(ground.Row(row)), below_(ground.Row(row + 1)) {}
  struct Gradient {
    float by_column;
    float by_row;
  };
  [[nodiscard]] Gradient Right(std::int32_t x) const {
    return {above_[x + 1] - above_[x], below_[x + 1] - above_[x + 1]};
  }
  [[nodiscard]] Gradient Left(std::int32_t x) const {
    return {below_[x + 1] - below_[x], below_[x] - above_[x]};
  }

 private:
  const float* above_;
  const float* below_;
};

}  // namespace

float PostSquares::Of(const Place& a, const Place& b, const Place& c) const {
  const Plane plane(a, b, c);
  float squares = 0;
  float slopes = 0;
  float greatest = 0;
  const auto square = [&](const FacetRow::Gradient& ground) {
    const float by_column = ground.by_column - plane.by_column;
    const float by_row = ground.by_row - plane.by_row;
    return by_column * by_column + by_row * by_row;
  };
  ForEachRowUnder(a, b, c, [&](const RowUnderTriangle& under) {
    const float* f = ground_->Row(under.row);
    const float z = a.frame + plane.by_row * static_cast<float>(under.row - a.y);
    for (std::int32_t x = under.posts.first; x < under.posts.end; ++x) {
      const float off = f[x] - (z + plane.by_column * static_cast<float>(x - a.x));
      squares += off * off;
      greatest = std::max(greatest, off * off);
    }
    const FacetRow facets(*ground_, under.row);
    const ColumnRange& right = under.right_facets;
    for (std::int32_t x = right.first; x < right.end; ++x) slopes += square(facets.Right(x));
    const ColumnRange& left = under.left_facets;
    for (std::int32_t x = left.first; x < left.end; ++x) slopes += square(facets.Left(x));
  });
  if (greatest > most_) return std::numeric_limits<float>::infinity();
  return squares + kOfAFacet * slope_weight_ * slopes;
}

void PostSquares::AddPull(const Place& a, const Place& b, const Place& c, HeightPull& pull) const {
  const Plane plane(a, b, c);
  const float weight_by_column = static_cast<float>(b.y - c.y) * plane.inverse;  // 1 at a
  const float weight_by_row = static_cast<float>(c.x - b.x) * plane.inverse;
  float by_column = 0;
  float by_row = 0;
  float slopes = 0;
  std::int32_t facets = 0;
  const auto add = [&](const FacetRow::Gradient& ground) {
    const float off_by_column = ground.by_column - plane.by_column;
    const float off_by_row = ground.by_row - plane.by_row;
    by_column += off_by_column;
    by_row += off_by_row;
    slopes += off_by_column * off_by_column + off_by_row * off_by_row;
  };
  ForEachRowUnder(a, b, c, [&](const RowUnderTriangle& under) {
    const float* f = ground_->Row(under.row);
    const auto rows = static_cast<float>(under.row - a.y);
    const float z = a.frame + plane.by_row * rows;
    const float w = 1 + weight_by_row * rows;
    for (std::int32_t x = under.posts.first; x < under.posts.end; ++x) {
      const auto steps = static_cast<float>(x - a.x);
      const float weight = w + weight_by_column * steps;
      const float off = f[x] - (z + plane.by_column * steps);
      pull.pull += weight * off;
      pull.stiffness += weight * weight;
      pull.sum += off * off;
    }
    const FacetRow row(*ground_, under.row);
    const ColumnRange& right = under.right_facets;
    for (std::int32_t x = right.first; x < right.end; ++x) add(row.Right(x));
    const ColumnRange& left = under.left_facets;
    for (std::int32_t x = left.first; x < left.end; ++x) add(row.Left(x));
    facets += right.end - right.first + left.end - left.first;
  });
  const float worth = kOfAFacet * slope_weight_;
  pull.pull += worth * (weight_by_column * by_column + weight_by_row * by_row);
  pull.stiffness += worth * static_cast<float>(facets) *
                    (weight_by_column * weight_by_column + weight_by_row * weight_by_row);
  pull.sum += worth * slopes;
}

float PostSquares::OfRim(const Place& a, const Place& b) const {
  const int columns = b.x - a.x;
  const int rows = b.y - a.y;
  if (rows < 0 || (rows == 0 && columns > 0)) return 0;  // a left or an upper edge
  const int steps = std::max(std::abs(columns), rows);
  const auto length = static_cast<float>(steps);
  float sum = 0;
  float greatest = 0;
  for (int i = 0; i < steps; ++i) {
    const float mesh = a.frame + (b.frame - a.frame) * static_cast<float>(i) / length;
    const float off = ground_->Row(a.y + rows / steps * i)[a.x + columns / steps * i] - mesh;
    sum += off * off;
    greatest = std::max(greatest, off * off);
  }
  return greatest > most_ ? std::numeric_limits<float>::infinity() : sum;
}

}  // namespace farhorizon
