// A triangle that the line crosses becomes two or three, a wall two. The new vertex of an edge is
// made once, from its lesser end on, so that triangles on both sides of the edge, and tiles on both
// sides of the line, have the same bytes.
#include "core/pipeline/terrain_tiles/split_part.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "core/geo/ellipsoid.h"

namespace farhorizon {

namespace {

class Splitter {
 public:
  Splitter(Axis axis, std::int64_t at, std::vector<GlobeVertex>& vertices)
      : axis_(axis), at_(at), vertices_(&vertices) {}

  void Add(const std::array<std::uint32_t, 3>& t) {
    const std::array<int, 3> sides = {SideOf(t[0]), SideOf(t[1]), SideOf(t[2])};
    const auto [least, greatest] = std::minmax({sides[0], sides[1], sides[2]});
    if (least == 0 && greatest == 0) return;  // rounded away: it has no width
    if (least >= 0 || greatest <= 0) {
      Half(least + greatest).triangles.push_back(t);
      return;
    }
    // The corner that the line goes through; else the one that it parts from both others.
    std::size_t k = 0;
    const bool through = std::ranges::count(sides, 0) > 0;
    while (through ? sides[k] != 0 : sides[(k + 1) % 3] != sides[(k + 2) % 3]) ++k;
    const std::uint32_t a = t[k];
    const std::uint32_t b = t[(k + 1) % 3];
    const std::uint32_t c = t[(k + 2) % 3];
    if (sides[k] == 0) {
      const std::uint32_t bc = Cut(b, c);
      Half(SideOf(b)).triangles.push_back({a, b, bc});
      Half(SideOf(c)).triangles.push_back({a, bc, c});
      return;
    }
    const std::uint32_t ab = Cut(a, b);
    const std::uint32_t ca = Cut(c, a);
    Half(sides[k]).triangles.push_back({a, ab, ca});
    Half(-sides[k]).triangles.push_back({ab, b, c});
    Half(-sides[k]).triangles.push_back({ab, c, ca});
  }

  void Add(const std::array<std::uint32_t, 4>& wall) {
    const auto [a, b, fill_b, fill_a] = wall;
    const int side_a = SideOf(a);
    const int side_b = SideOf(b);
    if (side_a * side_b < 0) {
      const std::uint32_t ground = Cut(a, b);
      const std::uint32_t fill = Cut(fill_a, fill_b);
      Half(side_a).walls.push_back({a, ground, fill, fill_a});
      Half(side_b).walls.push_back({ground, b, fill_b, fill});
    } else if (side_a + side_b != 0) {
      Half(side_a + side_b).walls.push_back(wall);
    } else {
      const LatticePoint& from = (*vertices_)[a].place;
      const LatticePoint& to = (*vertices_)[b].place;
      // The ground is to the left of a to b: in the west of a way to the north.
      Half(axis_ == Axis::kX ? (to.y > from.y ? -1 : 1) : (to.x > from.x ? 1 : -1))
          .walls.push_back(wall);
    }
  }

  std::array<GlobePart, 2> Take() && { return std::move(halves_); }

 private:
  GlobePart& Half(int side) { return halves_[side < 0 ? 0 : 1]; }

  [[nodiscard]] int SideOf(std::uint32_t vertex) const {
    const LatticePoint& place = (*vertices_)[vertex].place;
    const std::int64_t value = axis_ == Axis::kX ? place.x : place.y;
    return static_cast<int>(value > at_) - static_cast<int>(value < at_);
  }

  // The vertex at which the line cuts an edge. Its bytes do not depend on the edge's sense.
  std::uint32_t Cut(std::uint32_t a, std::uint32_t b) {
    if ((*vertices_)[b].place < (*vertices_)[a].place) std::swap(a, b);
    const auto next = static_cast<std::uint32_t>(vertices_->size());
    const auto [found, is_new] =
        cuts_.try_emplace(std::uint64_t{a} << 32U | std::uint64_t{b}, next);
    if (is_new) vertices_->push_back(Between((*vertices_)[a], (*vertices_)[b]));
    return found->second;
  }

  [[nodiscard]] GlobeVertex Between(const GlobeVertex& a, const GlobeVertex& b) const {
    GlobeVertex cut;
    const std::int64_t dx = b.place.x - a.place.x;
    const std::int64_t dy = b.place.y - a.place.y;
    const bool by_x = axis_ == Axis::kX;
    const double share = static_cast<double>(at_ - (by_x ? a.place.x : a.place.y)) /
                         static_cast<double>(by_x ? dx : dy);
    const auto along = [share](std::int64_t from, std::int64_t difference) {
      return from + std::llround(share * static_cast<double>(difference));
    };
    cut.place =
        by_x ? LatticePoint{at_, along(a.place.y, dy)} : LatticePoint{along(a.place.x, dx), at_};
    cut.height_m = a.height_m + share * (b.height_m - a.height_m);
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      cut.normal[k] = static_cast<float>((1 - share) * a.normal[k] + share * b.normal[k]);
      square += double{cut.normal[k]} * cut.normal[k];
    }
    for (float& n : cut.normal) n = static_cast<float>(n / std::sqrt(square));
    cut.is_ground = a.is_ground && b.is_ground;
    if (!cut.is_ground) {
      cut.normal = UpAt(cut.place);
      return cut;  // on the ellipsoid, without an edge under it
    }
    // The edge's chord is under the arc by share (1 - share) length^2 / 2 R.
    const Ecef from = EcefOf(GeodeticOf(a.place, 0));
    const Ecef to = EcefOf(GeodeticOf(b.place, 0));
    const double length2 = (to.x - from.x) * (to.x - from.x) + (to.y - from.y) * (to.y - from.y) +
                           (to.z - from.z) * (to.z - from.z);
    // WGS 84 has no smaller radius of curvature, a (1 - e^2).
    constexpr double kLeastRadiusM = 6335000;
    cut.lift_m = static_cast<float>((1 - share) * a.lift_m + share * b.lift_m +
                                    share * (1 - share) * length2 / (2 * kLeastRadiusM));
    return cut;
  }

  Axis axis_;
  std::int64_t at_;
  std::vector<GlobeVertex>* vertices_;
  std::unordered_map<std::uint64_t, std::uint32_t> cuts_;
  std::array<GlobePart, 2> halves_;
};

}  // namespace

std::array<GlobePart, 2> SplitPart(const GlobePart& part, Axis axis, std::int64_t at,
                                   std::vector<GlobeVertex>& vertices) {
  Splitter splitter(axis, at, vertices);
  for (const auto& triangle : part.triangles) splitter.Add(triangle);
  for (const auto& wall : part.walls) splitter.Add(wall);
  return std::move(splitter).Take();
}

}  // namespace farhorizon
