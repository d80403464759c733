// A triangle is taken row by row. The columns that a row has under it follow from the triangle's
// edges; an edge is computed from its upper end, whichever triangle asks, so that the triangles on
// both sides of it round alike and none of its posts counts twice or never.
#include "core/simplify/mesh/squares.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace farhorizon {

namespace {

// A post within this of an edge, columns, is on it. Posts beside an edge of n rows are at least
// 1 / n away from it.
constexpr float kOnEdge = 1e-4F;

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

// visit(row, first column, column after the last) for each row of the triangle that has posts.
template <typename Visit>
void ForEachRow(Place a, Place b, Place c, Visit visit) {
  if (a.y > b.y) std::swap(a, b);
  if (b.y > c.y) std::swap(b, c);
  if (a.y > b.y) std::swap(a, b);
  const auto slope = [](const Place& p, const Place& q) {
    return q.y > p.y ? static_cast<float>(q.x - p.x) / static_cast<float>(q.y - p.y) : 0.0F;
  };
  const auto column = [](const Place& from, int row, float by_row) {
    const float off = static_cast<float>(row - from.y) * by_row - kOnEdge;
    const int whole = static_cast<int>(off);
    return from.x + whole + static_cast<int>(off > static_cast<float>(whole));  // std::ceil
  };
  const float along = slope(a, c);
  const float upper = slope(a, b);
  const float lower = slope(b, c);
  const auto row = [&](int r, int one, int other) {
    const auto [first, end] = std::minmax(one, other);
    if (first < end) visit(r, first, end);
  };
  for (int r = a.y; r < b.y; ++r) row(r, column(a, r, along), column(a, r, upper));
  for (int r = b.y; r < c.y; ++r) row(r, column(a, r, along), column(b, r, lower));
}

}  // namespace

float Squares(const Ground& ground, const Place& a, const Place& b, const Place& c, float most_m) {
  const Plane plane(a, b, c);
  const float most = most_m * most_m;
  float sum = 0;
  float greatest = 0;
  ForEachRow(a, b, c, [&](int r, int first, int end) {
    const float* f = ground.Row(r);
    const float z = a.frame + plane.by_row * static_cast<float>(r - a.y);
    for (int x = first; x < end; ++x) {
      const float off = f[x] - (z + plane.by_column * static_cast<float>(x - a.x));
      const float square = off * off;
      sum += square;
      greatest = std::max(greatest, square);
    }
  });
  return greatest > most ? std::numeric_limits<float>::infinity() : sum;
}

void AddPull(const Ground& ground, const Place& a, const Place& b, const Place& c,
             HeightPull& sum) {
  const Plane plane(a, b, c);
  const float weight_by_column = static_cast<float>(b.y - c.y) * plane.inverse;  // 1 at a
  const float weight_by_row = static_cast<float>(c.x - b.x) * plane.inverse;
  ForEachRow(a, b, c, [&](int r, int first, int end) {
    const float* f = ground.Row(r);
    const auto rows = static_cast<float>(r - a.y);
    const float z = a.frame + plane.by_row * rows;
    const float w = 1 + weight_by_row * rows;
    for (int x = first; x < end; ++x) {
      const auto columns = static_cast<float>(x - a.x);
      const float weight = w + weight_by_column * columns;
      sum.pull += weight * (f[x] - (z + plane.by_column * columns));
      sum.stiffness += weight * weight;
    }
  });
}

float RimSquares(const Ground& ground, const Place& a, const Place& b, float most_m) {
  const int columns = b.x - a.x;
  const int rows = b.y - a.y;
  if (rows < 0 || (rows == 0 && columns > 0)) return 0;  // a left or an upper edge
  const int steps = std::max(std::abs(columns), rows);
  const auto length = static_cast<float>(steps);
  const float most = most_m * most_m;
  float sum = 0;
  float greatest = 0;
  for (int i = 0; i < steps; ++i) {
    const float mesh = a.frame + (b.frame - a.frame) * static_cast<float>(i) / length;
    const float off = ground.Row(a.y + rows / steps * i)[a.x + columns / steps * i] - mesh;
    sum += off * off;
    greatest = std::max(greatest, off * off);
  }
  return greatest > most ? std::numeric_limits<float>::infinity() : sum;
}

}  // namespace farhorizon
