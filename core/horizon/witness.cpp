// A line of sight checked against the heights themselves. It crosses the edges of the terrain along
// four families of grid lines: rows, columns and two diagonals. In each family the line crosses
// each grid line once, at a place between two neighbouring posts; the terrain decides whether an
// edge joins the two. Exact: in 128-bit integers where these hold all products, else in 1280 bits.
// Cost: O(columns + rows) crossings.
#include "core/horizon/witness.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/exact/int128.h"
#include "core/exact/int1280.h"
#include "core/geometry/floor_divide.h"
#include "core/geometry/grid_lines.h"

namespace farhorizon {

namespace {

// The line through (x, y) / 2^bits in the direction (dc, dr), at the height z / 2^bits.
template <typename Int>
struct LineOfSight {
  Int x;
  Int y;
  Int z;
  int bits;
  Int dc;
  Int dr;
};

Int128 FloorOf(Int128 a, Int128 b, int /*bits*/) { return FloorDivide(a, b); }

// The quotient is exact where it is below 2^30 in size; else it is 2^30 with its sign.
// Requires: b > 0, a multiple of 2^bits.
Int1280 FloorOf(const Int1280& a, const Int1280& b, int bits) {
  const double near = static_cast<double>(a >> bits) / static_cast<double>(b >> bits);
  constexpr double kFar = 0x1p30;
  Int1280 quotient(static_cast<std::int64_t>(std::clamp(near, -kFar, kFar)));
  if (std::abs(near) >= kFar) return quotient;
  const Int1280 one(1);
  while (quotient * b > a) quotient = quotient - one;
  while ((quotient + one) * b <= a) quotient = quotient + one;
  return quotient;
}

template <typename Int>
class WitnessChecker {
 public:
  WitnessChecker(const Terrain& terrain, const LineOfSight<Int>& line)
      : terrain_(terrain), line_(line) {}

  [[nodiscard]] bool ClearsAll() const {
    const auto families = FamiliesOfGridLines(terrain_.dem().columns, terrain_.dem().rows);
    return std::all_of(families.begin(), families.end(),
                       [this](const GridLines& family) { return Clears(family); });
  }

 private:
  // Whether no edge of the family rises above the line.
  [[nodiscard]] bool Clears(const GridLines& family) const {
    const auto [i0, j0] = family.PositionOf(line_.x, line_.y);
    auto [di, dj] = family.PositionOf(line_.dc, line_.dr);
    if (SignOf(di) == 0) return true;  // parallel to the family: other families have its posts
    if (SignOf(di) < 0) {
      di = -di;
      dj = -dj;
    }
    const Int whole = di << line_.bits;
    const Int most{1 << 20};  // beyond all posts, and j below it fits 32 bits
    for (std::int32_t i = family.first; i <= family.last; ++i) {
      const Int numerator = j0 * di + ((Int{i} << line_.bits) - i0) * dj;
      const Int j = FloorOf(numerator, whole, line_.bits);
      if (j < -most || j > most) continue;
      const Int rest = numerator - j * whole;
      if (!ClearsAt(family, i, static_cast<std::int32_t>(static_cast<std::int64_t>(j)), rest, di)) {
        return false;
      }
    }
    return true;
  }

  // Whether the edge from post j of line i to the next post is not above the line of sight, which
  // crosses it at rest / (step * 2^bits) of the way. All heights here are times step * 2^bits.
  [[nodiscard]] bool ClearsAt(const GridLines& family, std::int32_t i, std::int32_t j,
                              const Int& rest, const Int& step) const {
    const auto [column, row] = family.Post(i, j);
    if (!Inside(column, row)) return true;
    const VertexId p = row * terrain_.dem().columns + column;
    const Int whole = step << line_.bits;
    const Int own = line_.z * step;
    if (SignOf(rest) == 0) return !(Int{Height(p)} * whole > own) || !terrain_.IsVertex(p);
    if (!Inside(column + family.along_column, row + family.along_row)) return true;
    const VertexId q = p + family.along_row * terrain_.dem().columns + family.along_column;
    if (!terrain_.dem().HasData(p) || !terrain_.dem().HasData(q)) return true;
    if (!(Int{Height(p)} * whole + rest * Int{Height(q) - Height(p)} > own)) return true;
    const Terrain::Faces faces = terrain_.FacesOf(MakeEdge(p, q));
    return !faces.left && !faces.right;
  }

  [[nodiscard]] bool Inside(std::int32_t column, std::int32_t row) const {
    return column >= 0 && column < terrain_.dem().columns && row >= 0 && row < terrain_.dem().rows;
  }
  [[nodiscard]] std::int64_t Height(VertexId v) const {
    return terrain_.dem().heights[static_cast<std::size_t>(v)];
  }

  const Terrain& terrain_;
  const LineOfSight<Int>& line_;
};

// Whether the line through n / 2^bits of the way from a to b clears the terrain.
template <typename Int>
bool Clears(const Terrain& terrain, Point3i a, Point3i b, std::int64_t n, int bits,
            const Witness& witness) {
  const auto at = [n, bits](std::int64_t from, std::int64_t to) {
    return (Int{from} << bits) + Int{to - from} * Int{n};
  };
  const LineOfSight<Int> line{at(a.x, b.x), at(a.y, b.y),    at(a.z, b.z),
                              bits,         Int{witness.dc}, Int{witness.dr}};
  return WitnessChecker<Int>(terrain, line).ClearsAll();
}

constexpr std::int64_t kMostDirection = std::int64_t{1} << 62;

bool IsDirection(const Witness& w) {
  return w.dc < kMostDirection && w.dc > -kMostDirection && w.dr < kMostDirection &&
         w.dr > -kMostDirection && (w.dc != 0 || w.dr != 0);
}

int BitsOf(std::int64_t value) {
  return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(value < 0 ? -value : value)));
}

}  // namespace

bool WitnessHolds(const Terrain& terrain, Edge edge, const Witness& witness) {
  const Terrain::Faces faces = terrain.FacesOf(edge);
  if (!faces.left && !faces.right) return false;
  if (!(witness.t >= 0 && witness.t <= 1) || !witness.exact || !IsDirection(witness)) return false;
  int exponent = 0;
  auto n = static_cast<std::int64_t>(std::ldexp(std::frexp(witness.t, &exponent), 53));
  int bits = n == 0 ? 0 : 53 - exponent;
  // Lowest terms keep the products small.
  for (; bits > 0 && n % 2 == 0; --bits) n /= 2;
  const Point3i a = terrain.Point(edge.a);
  const Point3i b = terrain.Point(edge.b);
  // The largest products are those of ClearsAt: a height or a difference of two, 31 bits, times
  // step * 2^bits, where step is a sum of two components of the direction. A sum of two products
  // has 31 + 1 + 1 + direction_bits + bits bits, at most 123 of the 127 that Int128 has.
  constexpr int kNarrowBits = 90;
  const int direction_bits = std::max(BitsOf(witness.dc), BitsOf(witness.dr));
  return direction_bits + bits <= kNarrowBits ? Clears<Int128>(terrain, a, b, n, bits, witness)
                                              : Clears<Int1280>(terrain, a, b, n, bits, witness);
}

}  // namespace farhorizon
