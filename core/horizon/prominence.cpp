#include "core/horizon/prominence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace farhorizon {
namespace {

// How many patches are asked; an edge has four or five.
constexpr std::size_t kMostPatches = 3;

struct PlanVector {
  double x;
  double y;
};

PlanVector At(const PlanMotion& motion, double t) {
  return {motion.ax + t * motion.bx, motion.ay + t * motion.by};
}

PlanVector Normalized(PlanVector v) {
  const double length = std::hypot(v.x, v.y);
  return {v.x / length, v.y / length};
}

// The direction half way between those of a patch at t.
PlanVector MiddleDirection(const SightPatch& patch, double t) {
  const PlanVector first = Normalized(At(patch.first, t));
  const PlanVector last = Normalized(At(patch.last, t));
  const PlanVector sum{first.x + last.x, first.y + last.y};
  // Opposite to each other: all directions, of which the middle is a quarter turn on.
  if (std::hypot(sum.x, sum.y) < 1e-9) return {-first.y, first.x};
  return Normalized(sum);
}

// About the measure of its lines.
double Width(const SightPatch& patch) {
  const double t = (patch.from + patch.to) / 2;
  const PlanVector first = Normalized(At(patch.first, t));
  const PlanVector last = Normalized(At(patch.last, t));
  return (patch.to - patch.from) * std::hypot(last.x - first.x, last.y - first.y);
}

// A family of parallel grid lines: posts are i steps across and j along.
struct Family {
  std::int32_t along_column;
  std::int32_t along_row;
  std::int32_t across_column;
  std::int32_t across_row;
};

// The heights of the terrain's edges along a plan line.
class LineWalk {
 public:
  LineWalk(const Terrain& terrain, Edge except, double x, double y, PlanVector direction)
      : terrain_(terrain),
        columns_(terrain.dem().columns),
        rows_(terrain.dem().rows),
        heights_(terrain.dem().heights.data()),
        except_(except),
        x_(x),
        y_(y),
        direction_(direction) {
    Clip(x, direction.x, columns_ - 1);
    Clip(y, direction.y, rows_ - 1);
  }

  double Highest(bool has_holes) {
    Walk({1, 0, 0, 1}, 0, rows_ - 1);
    Walk({0, 1, 1, 0}, 0, columns_ - 1);
    Walk({1, 1, 1, 0}, -(rows_ - 1), columns_ - 1);
    // The other diagonal is an edge beside holes only.
    if (has_holes) Walk({-1, 1, 1, 0}, 0, columns_ + rows_ - 2);
    return highest_;
  }

 private:
  // Narrows [from_, to_], where the line is above the grid, as distances from (x, y).
  void Clip(double start, double step, double end) {
    if (step == 0) return;
    const double at_0 = -start / step;
    const double at_end = (end - start) / step;
    from_ = std::max(from_, std::min(at_0, at_end));
    to_ = std::min(to_, std::max(at_0, at_end));
  }

  void Walk(const Family& f, std::int32_t first, std::int32_t last) {
    // (column, row) = i across + j along; the basis has determinant 1 or -1.
    const double det = f.across_column * f.along_row - f.across_row * f.along_column;
    const double i0 = (x_ * f.along_row - y_ * f.along_column) * det;
    const double j0 = (y_ * f.across_column - x_ * f.across_row) * det;
    const double di = (direction_.x * f.along_row - direction_.y * f.along_column) * det;
    const double dj = (direction_.y * f.across_column - direction_.x * f.across_row) * det;
    if (std::abs(di) < 1e-12) return;  // along the family: met by the others
    const double start = std::min(i0 + from_ * di, i0 + to_ * di);
    const double end = std::max(i0 + from_ * di, i0 + to_ * di);
    // One more on either side, for what rounding does.
    const double begin = std::max<double>(first, std::ceil(start) - 1);
    const double past = std::min<double>(last, std::floor(end) + 1);
    const double slope = dj / di;
    for (auto i = static_cast<std::int32_t>(begin); i <= past; ++i) {
      const double j = j0 + (i - i0) * slope;
      if (j > -1 && j < columns_ + rows_) Meet(f, i, j);
    }
  }

  void Meet(const Family& f, std::int32_t i, double j) {
    const auto whole = static_cast<std::int32_t>(std::floor(j));
    const std::int32_t column = i * f.across_column + whole * f.along_column;
    const std::int32_t row = i * f.across_row + whole * f.along_row;
    const std::int32_t next_column = column + f.along_column;
    const std::int32_t next_row = row + f.along_row;
    if (std::min(column, next_column) < 0 || std::max(column, next_column) >= columns_ ||
        std::min(row, next_row) < 0 || std::max(row, next_row) >= rows_) {
      return;
    }
    const VertexId p = row * columns_ + column;
    const VertexId q = next_row * columns_ + next_column;
    const double low = heights_[p];
    const double high = heights_[q];
    const double height = low + (j - whole) * (high - low);
    if (height <= highest_ || low == kNoHeight || high == kNoHeight || MakeEdge(p, q) == except_) {
      return;
    }
    const Terrain::Faces faces = terrain_.FacesOf(MakeEdge(p, q));
    if (faces.left || faces.right) highest_ = height;
  }

  const Terrain& terrain_;
  std::int32_t columns_;
  std::int32_t rows_;
  const std::int32_t* heights_;
  Edge except_;
  double x_;
  double y_;
  PlanVector direction_;
  double from_ = -std::numeric_limits<double>::infinity();
  double to_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

Prominences::Prominences(const Terrain& terrain)
    : terrain_(terrain),
      has_holes_(std::count(terrain.dem().heights.begin(), terrain.dem().heights.end(), kNoHeight) >
                 0) {}

double Prominences::Of(Edge edge, const Sights& sights) const {
  std::vector<const SightPatch*> widest;
  for (const SightPatch& patch : sights) widest.push_back(&patch);
  const std::size_t count = std::min(kMostPatches, widest.size());
  std::partial_sort(widest.begin(), widest.begin() + static_cast<std::ptrdiff_t>(count),
                    widest.end(),
                    [](const SightPatch* p, const SightPatch* q) { return Width(*p) > Width(*q); });
  const Point3i a = terrain_.Point(edge.a);
  const Point3i b = terrain_.Point(edge.b);
  double most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = (widest[i]->from + widest[i]->to) / 2;
    LineWalk walk(terrain_, edge, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                  MiddleDirection(*widest[i], t));
    const double own = a.z + t * (static_cast<double>(b.z) - a.z);
    const double other = walk.Highest(has_holes_);
    if (std::isfinite(other)) most = std::max(most, own - other);
  }
  return most;
}

}  // namespace farhorizon
