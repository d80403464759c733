// Heights on sides have to decode alike in both tiles, each of which has a least and a greatest
// height of its own. Both are made multiples of steps that are powers of two, the finer ones parts
// of the coarser ones, so that a coarse multiple is a whole number in either tile. The heights of
// the header are floats, which hold them without rounding.
#include "core/pipeline/terrain_tiles/quantize_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "core/geo/ellipsoid.h"

namespace farhorizon {

namespace {

// Of heights: as fine as any DEM is worth.
constexpr double kFinestStepM = 0x1p-10;
// A float holds whole numbers below it.
constexpr double kFloatWhole = 0x1p24;

// The tile's heights from `least` on in kMostQuantized steps.
struct HeightScale {
  double least_m = 0;
  double step_m = 0;

  [[nodiscard]] double GreatestM() const { return least_m + kMostQuantized * step_m; }
  [[nodiscard]] int Of(double height_m) const {
    return static_cast<int>(std::lround((height_m - least_m) / step_m));
  }
};

HeightScale ScaleOf(double least_m, double greatest_m, double coarsest_step_m) {
  HeightScale scale = {std::floor(least_m / coarsest_step_m) * coarsest_step_m, coarsest_step_m};
  for (;;) {
    HeightScale finer = scale;
    finer.step_m /= 2;
    const double most = std::max(std::abs(finer.least_m), std::abs(finer.GreatestM()));
    // Sides are rounded by half a coarse step, maybe upwards.
    if (finer.GreatestM() < greatest_m + coarsest_step_m / 2) return scale;
    if (finer.step_m < kFinestStepM || most / finer.step_m >= kFloatWhole) return scale;
    scale = finer;
  }
}

// The nearest of kMostQuantized steps over `side`; at either end only what lies there.
int Quantized(std::int64_t offset, std::int64_t side) {
  if (offset == 0) return 0;
  if (offset == side) return kMostQuantized;
  const std::int64_t nearest = (2 * offset * kMostQuantized + side) / (2 * side);
  return static_cast<int>(std::clamp<std::int64_t>(nearest, 1, kMostQuantized - 1));
}

class Quantizer {
 public:
  Quantizer(const TileAddress& address, const std::vector<GlobeVertex>& vertices,
            double height_step_m)
      : vertices_(&vertices), height_step_m_(height_step_m), side_(TileSide(address.zoom)) {
    west_ = address.x * side_;
    south_ = address.y * side_;
    const Geodetic least = GeodeticOf({west_, south_}, 0);
    const Geodetic greatest = GeodeticOf({west_ + side_, south_ + side_}, 0);
    result_.tile.rectangle = {least.lon_deg, least.lat_deg, greatest.lon_deg, greatest.lat_deg};
  }

  QuantizedPart Run(const GlobePart& part) && {
    for (const auto& t : part.triangles) {
      for (const std::uint32_t corner : t) Include(corner);
    }
    for (const auto& w : part.walls) {
      for (const std::uint32_t corner : w) Include(corner);
    }
    const HeightScale scale = ScaleOf(least_m_, greatest_m_, height_step_m_);
    // Floats hold both.
    result_.tile.heights_m = {static_cast<float>(scale.least_m),
                              static_cast<float>(scale.GreatestM())};
    SetHeights(scale);
    for (const auto& t : part.triangles) Add(t);
    for (const auto& [a, b, fill_b, fill_a] : part.walls) {
      Add({fill_a, fill_b, b});
      Add({fill_a, b, a});
    }
    DropUnused();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool IsOnSide(const LatticePoint& p) const {
    return p.x == west_ || p.y == south_ || p.x == west_ + side_ || p.y == south_ + side_;
  }

  // Gives the vertex a number in the tile; one place has one number for the ground and one for what
  // is beside it.
  void Include(std::uint32_t vertex) {
    const auto [known, is_new] = numbers_.try_emplace(vertex, 0U);
    if (!is_new) return;
    const GlobeVertex& v = (*vertices_)[vertex];
    const int at_u = Quantized(v.place.x - west_, side_);
    const int at_v = Quantized(v.place.y - south_, side_);
    const std::uint64_t key = static_cast<std::uint64_t>(at_u) << 32U |
                              static_cast<std::uint64_t>(at_v) << 1U |
                              static_cast<std::uint64_t>(v.is_ground);
    const auto next = static_cast<std::uint32_t>(heights_.size());
    const auto [place, is_first] = places_.try_emplace(key, next);
    known->second = place->second;
    double height_m = v.height_m;
    if (IsOnSide(v.place)) height_m = std::round(height_m / height_step_m_) * height_step_m_;
    least_m_ = std::min(least_m_, height_m);
    greatest_m_ = std::max(greatest_m_, height_m);
    if (is_first) {
      heights_.push_back(height_m);
      result_.tile.vertices.push_back(
          {static_cast<std::uint16_t>(at_u), static_cast<std::uint16_t>(at_v), 0, v.normal});
    } else if (height_m > heights_[place->second]) {
      heights_[place->second] = height_m;
      result_.tile.vertices[place->second].normal = v.normal;
    }
  }

  void SetHeights(const HeightScale& scale) {
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      result_.tile.vertices[i].height = static_cast<std::uint16_t>(scale.Of(heights_[i]));
    }
    double rise_m = 0;
    double lift_m = 0;
    bool has_ground = false;
    for (const auto& [vertex, number] : numbers_) {
      const GlobeVertex& v = (*vertices_)[vertex];
      const double decoded_m = scale.least_m + result_.tile.vertices[number].height * scale.step_m;
      rise_m = std::max(rise_m, std::abs(decoded_m - v.height_m));
      lift_m = std::max(lift_m, double{v.lift_m});
      (v.is_ground ? has_ground : result_.has_fill) = true;
    }
    // In plan a vertex of the ground moves by half a step along both coordinates at most, a whole
    // one where it lies so close to a side that it would have been put on it.
    const double step_m = std::numbers::pi * kEquatorialRadiusM * static_cast<double>(side_) /
                          static_cast<double>(kHalfTurn) / kMostQuantized;
    result_.moved_m = rise_m + lift_m + (has_ground ? std::numbers::sqrt2 * step_m : 0);
  }

  void Add(const std::array<std::uint32_t, 3>& triangle) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = numbers_.at(triangle[k]);
    const auto same = [this](std::uint32_t a, std::uint32_t b) {
      const QuantizedVertex& p = result_.tile.vertices[a];
      const QuantizedVertex& q = result_.tile.vertices[b];
      return p.u == q.u && p.v == q.v && p.height == q.height;
    };
    if (same(corners[0], corners[1]) || same(corners[1], corners[2]) ||
        same(corners[2], corners[0])) {
      return;
    }
    result_.tile.triangles.push_back(corners);
  }

  void DropUnused() {
    QuantizedTile& tile = result_.tile;
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(tile.vertices.size(), kUnused);
    std::vector<QuantizedVertex> used;
    for (auto& triangle : tile.triangles) {
      for (std::uint32_t& corner : triangle) {
        if (number[corner] == kUnused) {
          number[corner] = static_cast<std::uint32_t>(used.size());
          used.push_back(tile.vertices[corner]);
        }
        corner = number[corner];
      }
    }
    tile.vertices = std::move(used);
  }

  const std::vector<GlobeVertex>* vertices_;
  double height_step_m_;
  std::int64_t side_;
  std::int64_t west_ = 0;
  std::int64_t south_ = 0;
  double least_m_ = std::numeric_limits<double>::infinity();
  double greatest_m_ = -std::numeric_limits<double>::infinity();
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
  std::unordered_map<std::uint64_t, std::uint32_t> places_;
  std::vector<double> heights_;
  QuantizedPart result_;
};

}  // namespace

double HeightStepOf(double least_m, double greatest_m) {
  // One step is lost where the least height is put on a multiple, one where sides are rounded.
  const double room = (greatest_m - least_m) / (kMostQuantized - 2);
  return std::max(kFinestStepM, std::exp2(std::ceil(std::log2(room))));
}

QuantizedPart QuantizePart(const TileAddress& address, const GlobePart& part,
                           const std::vector<GlobeVertex>& vertices, double height_step_m) {
  return Quantizer(address, vertices, height_step_m).Run(part);
}

}  // namespace farhorizon
