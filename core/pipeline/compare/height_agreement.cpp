// A mesh in feet, upside down or above another datum has errors of its own size everywhere, and no
// figure of them would say why. So slope and offset are looked at first, against what simplifying
// can do, and the refusal names the cause that fits and the option that settles it.
#include "core/pipeline/compare/height_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/io/geojson_text.h"

namespace farhorizon {

namespace {

// Heights that follow the DEM's as closely as this, or the other way round, do so by no accident.
constexpr double kFollows = 0.9;
// Simplifying flattens: the coarsest of levels have slopes from 0.9 to 1.02. Feet for metres are
// 3.28 or 0.305.
constexpr double kLeastSlope = 0.7;
constexpr double kMostSlope = 1.4;
// A mesh whose errors scatter by s about their median has that median below s; datums differ by
// metres to a hundred of them.
constexpr double kOffsetSpreads = 8;
constexpr double kOffsetM = 1;

double MedianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Error Elsewhere(const std::string& text) {
  return {ErrorCode::kUnsupportedData, "the mesh does not lie on the DEM: " + text,
          "mesh-elsewhere"};
}

std::string UnitText(double slope) {
  constexpr double kFootM = 0.3048;
  if (std::abs(slope * kFootM - 1) < 0.05) {
    return "; its heights look like feet where metres are expected";
  }
  if (std::abs(slope / kFootM - 1) < 0.05) {
    return "; its heights look like metres of a DEM that is in feet (--height-unit)";
  }
  return "; are they exaggerated, or in another unit?";
}

// What the ellipsoid's distance from the DEM's own vertical datum explains of the offset.
std::string DatumText(double offset_m, const TerrainInput& input) {
  const Dem& dem = input.dem();
  VertexId with_data = dem.columns * (dem.rows / 2) + dem.columns / 2;
  for (VertexId v = 0; !dem.HasData(with_data); ++v) with_data = v;
  const Result<std::vector<Geodetic>> place =
      input.georeference().ToGeodetic(std::vector<VertexId>{with_data});
  if (!place) return "";
  const double undulation = place->front().height_m - dem.HeightM(with_data);
  if (std::abs(undulation) < kOffsetM) {
    return ". The DEM's heights count from the ellipsoid: are the mesh's above a geoid, or the "
           "other way round? --vertical-datum states the DEM's";
  }
  const std::string here = ". The DEM's heights are above a geoid that is " +
                           Rounded(undulation, 2) + " m from the ellipsoid here";
  if (std::abs(offset_m - undulation) < 0.1 * std::abs(undulation) + 1) {
    return here + ": the mesh's seem to be above the ellipsoid";
  }
  if (std::abs(offset_m + undulation) < 0.1 * std::abs(undulation) + 1) {
    return here + ": the mesh's seem to be the DEM's without it, taken for ellipsoidal";
  }
  return here;
}

}  // namespace

HeightAgreement CompareHeights(const std::vector<double>& heights, const Dem& dem) {
  HeightAgreement agreement;
  std::vector<double> off;
  std::array<double, 2> mean = {0, 0};  // of the DEM, of the mesh
  for (std::size_t v = 0; v < heights.size(); ++v) {
    const auto post = static_cast<VertexId>(v);
    if (std::isnan(heights[v]) || !dem.HasData(post)) continue;
    off.push_back(heights[v] - dem.HeightM(post));
    mean[0] += dem.HeightM(post);
    mean[1] += heights[v];
  }
  if (off.empty()) return agreement;
  const auto count = static_cast<double>(off.size());
  agreement.posts = static_cast<std::int64_t>(off.size());
  mean = {mean[0] / count, mean[1] / count};
  agreement.mean_m = mean[1] - mean[0];
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (std::size_t v = 0; v < heights.size(); ++v) {
    const auto post = static_cast<VertexId>(v);
    if (std::isnan(heights[v]) || !dem.HasData(post)) continue;
    const double x = dem.HeightM(post) - mean[0];
    const double y = heights[v] - mean[1];
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  if (xx > 0 && yy > 0) {
    agreement.slope = xy / xx;
    agreement.correlation = xy / std::sqrt(xx * yy);
  }
  agreement.median_m = MedianOf(off);
  for (double& d : off) d = std::abs(d - agreement.median_m);
  agreement.spread_m = MedianOf(off);
  return agreement;
}

Status CheckHeights(const HeightAgreement& agreement, const TerrainInput& input) {
  if (agreement.correlation < -kFollows) {
    return Elsewhere("it is upside down, its heights fall where the DEM's rise (correlation " +
                     Rounded(agreement.correlation, 3) + ")");
  }
  if (agreement.correlation > kFollows &&
      (agreement.slope < kLeastSlope || agreement.slope > kMostSlope)) {
    return Elsewhere("it rises by " + Rounded(agreement.slope, 4) + " where the DEM rises by 1" +
                     UnitText(agreement.slope));
  }
  if (std::abs(agreement.median_m) > kOffsetSpreads * agreement.spread_m + kOffsetM) {
    return Elsewhere(
        "its heights are " + Rounded(std::abs(agreement.median_m), 3) + " m " +
        (agreement.median_m > 0 ? "above" : "below") + " the DEM's (median; half of them within " +
        Rounded(agreement.spread_m, 3) + " m of that)" + DatumText(agreement.median_m, input) +
        "; --mesh-height-offset " + Rounded(-agreement.median_m, 3) + " compares it as if moved");
  }
  return Ok{};
}

}  // namespace farhorizon
