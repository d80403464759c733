// A line of sight checked against the heights themselves: every terrain edge that it crosses is met
// once, along the rows, the columns and the two diagonals of the grid. Exact in 128-bit integers.
#include <cmath>

#include "core/exact/wide.h"
#include "core/horizon/horizon.h"

namespace farhorizon {
namespace {

// The line through (x, y) / scale with an integer direction, and its height z / scale.
struct SightLine {
  Int128 x;
  Int128 y;
  Int128 z;
  Int128 scale;
  Int128 dc;
  Int128 dr;
};

// A family of grid lines: along[] joins neighbouring posts on one line, across[] leads to the next
// one. Posts are from a + i * across + j * along.
struct Family {
  int along_column;
  int along_row;
  int across_column;
  int across_row;
};

Int128 FloorDivide(Int128 a, Int128 b) {
  const Int128 quotient = a / b;
  return quotient - ((a % b != 0 && (a < 0) != (b < 0)) ? 1 : 0);
}

class SightChecker {
 public:
  SightChecker(const Terrain& terrain, const SightLine& line) : terrain_(terrain), line_(line) {}

  // Whether no edge of the family rises above the line.
  [[nodiscard]] bool Clears(const Family& family, std::int32_t first, std::int32_t last) const {
    // Coordinates in the family's basis: (column, row) = i * across + j * along, unimodular.
    const Int128 det =
        family.across_column * family.along_row - family.across_row * family.along_column;
    const Int128 i0 = (line_.x * family.along_row - line_.y * family.along_column) * det;
    const Int128 j0 = (line_.y * family.across_column - line_.x * family.across_row) * det;
    const Int128 di = (line_.dc * family.along_row - line_.dr * family.along_column) * det;
    const Int128 dj = (line_.dr * family.across_column - line_.dc * family.across_row) * det;
    if (di == 0) return true;  // along the family: posts on it are met by the other families
    const Int128 sign = di < 0 ? -1 : 1;
    const Int128 denominator = line_.scale * di * sign;
    for (std::int32_t i = first; i <= last; ++i) {
      const Int128 numerator = (j0 * di + (i * line_.scale - i0) * dj) * sign;
      const Int128 j = FloorDivide(numerator, denominator);
      if (j < -(1 << 20) || j > (1 << 20)) continue;
      const Int128 part = numerator - j * denominator;
      if (!ClearsAt(family, i, static_cast<std::int32_t>(j), part, denominator)) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] bool ClearsAt(const Family& family, std::int32_t i, std::int32_t j, Int128 part,
                              Int128 whole) const {
    const std::int32_t column = i * family.across_column + j * family.along_column;
    const std::int32_t row = i * family.across_row + j * family.along_row;
    if (!Inside(column, row)) return true;
    const VertexId p = row * terrain_.dem().columns + column;
    if (part == 0) return !Above(Height(p) * whole, whole) || !terrain_.IsVertex(p);
    if (!Inside(column + family.along_column, row + family.along_row)) return true;
    const VertexId q = p + family.along_row * terrain_.dem().columns + family.along_column;
    if (!terrain_.dem().HasData(p) || !terrain_.dem().HasData(q)) return true;
    if (!Above(Height(p) * whole + part * (Height(q) - Height(p)), whole)) return true;
    const Terrain::Faces faces = terrain_.FacesOf(MakeEdge(p, q));
    return !faces.left && !faces.right;
  }

  [[nodiscard]] bool Inside(std::int32_t column, std::int32_t row) const {
    return column >= 0 && column < terrain_.dem().columns && row >= 0 && row < terrain_.dem().rows;
  }
  [[nodiscard]] Int128 Height(VertexId v) const {
    return terrain_.dem().heights[static_cast<std::size_t>(v)];
  }
  // Whether height / whole > z / scale.
  [[nodiscard]] bool Above(Int128 height, Int128 whole) const {
    return height > line_.z * (whole / line_.scale);
  }

  const Terrain& terrain_;
  const SightLine& line_;
};

}  // namespace

bool WitnessHolds(const Terrain& terrain, Edge edge, const Witness& witness) {
  const Terrain::Faces faces = terrain.FacesOf(edge);
  if (!faces.left && !faces.right) return false;
  if (!(witness.t >= 0 && witness.t <= 1) || (witness.dc == 0 && witness.dr == 0)) return false;
  constexpr int kBits = 52;
  const double scaled = std::ldexp(witness.t, kBits);
  const auto n = static_cast<std::int64_t>(scaled);
  if (static_cast<double>(n) != scaled) return false;  // no dyadic number of 52 bits
  // Halving as long as it is exact keeps the products small.
  int bits = kBits;
  std::int64_t t = n;
  while (bits > 0 && t % 2 == 0) {
    t /= 2;
    --bits;
  }
  const Point3i a = terrain.Point(edge.a);
  const Point3i b = terrain.Point(edge.b);
  const Int128 scale = Int128{1} << bits;
  const SightLine line{a.x * scale + Int128{b.x - a.x} * t,
                       a.y * scale + Int128{b.y - a.y} * t,
                       a.z * scale + (Int128{b.z} - a.z) * t,
                       scale,
                       witness.dc,
                       witness.dr};
  const SightChecker checker(terrain, line);
  const std::int32_t columns = terrain.dem().columns;
  const std::int32_t rows = terrain.dem().rows;
  return checker.Clears({1, 0, 0, 1}, 0, rows - 1) &&
         checker.Clears({0, 1, 1, 0}, 0, columns - 1) &&
         checker.Clears({1, 1, 1, 0}, -(rows - 1), columns - 1) &&
         checker.Clears({-1, 1, 1, 0}, 0, columns + rows - 2);
}

}  // namespace farhorizon
