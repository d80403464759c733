// Where the sample of a mesh comes to lie under a placing, and how well its heights follow the
// DEM's there. Triangles weigh by their area in plan, so that skirts weigh nothing.
#include "core/pipeline/compare/frame_fit.h"

#include <algorithm>
#include <cmath>

#include "core/base/infinity.h"
#include "core/pipeline/compare/terrain_height.h"
#include "core/pipeline/compare/weighted_correlation.h"

namespace farhorizon {

namespace {

// Triangles of a sample: any number is sound, this one tells correlations apart by a hundredth.
constexpr std::size_t kSampled = 4096;
constexpr double kLeastInside = 0.9;  // a skirt that flares out, or a rim, may be outside

double PlanArea(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return 0.5 * std::abs((b.column - a.column) * (c.row - a.row) -
                        (b.row - a.row) * (c.column - a.column));
}

// The heights are taken from about the DEM's middle height, so that squares stay small.
double CorrelationWithDem(const std::vector<GridPoint>& corners, const Dem& dem) {
  WeightedCorrelation sums;
  double about = 0;
  bool known = false;
  for (std::size_t i = 2; i < corners.size(); i += 3) {
    const GridPoint& a = corners[i - 2];
    const GridPoint& b = corners[i - 1];
    const GridPoint& c = corners[i];
    const std::optional<double> ground =
        TerrainHeightAt(dem, (a.column + b.column + c.column) / 3, (a.row + b.row + c.row) / 3);
    if (!ground) continue;
    if (!known) about = *ground;
    known = true;
    sums.Add(PlanArea(a, b, c), *ground - about,
             (a.height_m + b.height_m + c.height_m) / 3 - about);
  }
  return sums.Value();
}

bool IsCounted(MeshFrame frame) {
  return frame == MeshFrame::kCorner || frame == MeshFrame::kCornerDown ||
         frame == MeshFrame::kCentre;
}

// The share by which a step may differ from the nominal one. Degrees have metres of several makes:
// at one latitude, on a sphere, rounded.
constexpr double kSameStep = 0.02;

// Sets the steps of frames in metres from a corner or the middle: those that make the mesh reach
// from side to side, where they are near the nominal ones. A map's own steps stay, unless they are
// off by half a cell from side to side. least, most: the mesh's box, z up.
void FitSteps(const FilePoint& least, const FilePoint& most, const TerrainInput& input,
              MeshPlacing& placing) {
  const double slack = input.georeference().FullTurn() > 0 ? 0 : 0.5;
  const auto fit = [slack](double extent, double cells, double step) {
    const double off = std::abs(extent - cells * step);
    return off > slack * step && off < kSameStep * cells * step ? extent / cells : step;
  };
  placing.column_m = fit(most[0] - least[0], input.dem().columns - 1, placing.column_m);
  placing.row_m = fit(most[1] - least[1], input.dem().rows - 1, placing.row_m);
}

// Lays the mesh's box on the DEM's, whatever its size and its origin.
void FitBox(const FilePoint& least, const FilePoint& most, const Dem& dem, MeshPlacing& placing) {
  placing.column_m = (most[0] - least[0]) / (dem.columns - 1);
  placing.row_m = (most[1] - least[1]) / (dem.rows - 1);
  placing.origin = {least[0], least[1]};
}

// What was taken of the two extents: only frames from a corner can be laid on the DEM.
Extent FitCounted(const MeshSample& sample, Extent extent, const TerrainInput& input,
                  MeshPlacing& placing) {
  if (!IsCounted(placing.frame)) {
    placing.column_m = placing.row_m = 1;
    return Extent::kStated;
  }
  FilePoint least = ZUp(sample.extremes.front(), placing.up);
  FilePoint most = least;
  for (const FilePoint& point : sample.extremes) {
    const FilePoint p = ZUp(point, placing.up);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], p[axis]);
      most[axis] = std::max(most[axis], p[axis]);
    }
  }
  const bool flat = most[0] == least[0] || most[1] == least[1];
  if (extent == Extent::kWhole && placing.frame != MeshFrame::kCentre && !flat) {
    FitBox(least, most, input.dem(), placing);
    return Extent::kWhole;
  }
  FitSteps(least, most, input, placing);
  return Extent::kStated;
}

// Whether coordinates of this size can be of the frame at all: PROJ takes degrees modulo a turn.
bool Plausible(const MeshSample& sample, const MeshPlacing& placing) {
  constexpr double kLeastRadius = 6.3e6;  // metres, below any ground
  constexpr double kMostRadius = 6.5e6;
  return std::ranges::all_of(sample.extremes, [&](const FilePoint& p) {
    if (placing.frame == MeshFrame::kEcef) {
      const double radius = std::hypot(p[0], p[1], p[2]);
      return radius > kLeastRadius && radius < kMostRadius;
    }
    if (placing.frame == MeshFrame::kLonLat) {
      const double latitude = placing.up == UpAxis::kZ ? p[1] : p[2];
      return std::abs(p[0]) <= 360 && std::abs(latitude) <= 90;
    }
    return true;
  });
}

}  // namespace

bool FrameFit::Lies() const {
  return inside >= kLeastInside && greatest.column - least.column >= 0.5 &&
         greatest.row - least.row >= 0.5;
}

double FrameFit::Misfit() const { return std::sqrt(std::max(0.0, 1 - correlation * correlation)); }

MeshSample SampleOf(const FileMesh& mesh) {
  MeshSample sample;
  const std::size_t step = (mesh.triangles.size() + kSampled - 1) / kSampled;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += std::max<std::size_t>(step, 1)) {
    for (const std::uint32_t v : mesh.triangles[i]) sample.corners.push_back(mesh.points[v]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::ranges::minmax_element(
        mesh.points, [axis](const FilePoint& p, const FilePoint& q) { return p[axis] < q[axis]; });
    sample.extremes.push_back(*least);
    sample.extremes.push_back(*most);
  }
  return sample;
}

std::optional<FrameFit> FitFrame(const MeshSample& sample, MeshPlacing placing, Extent extent,
                                 const TerrainInput& input) {
  if (!Plausible(sample, placing)) return std::nullopt;
  const Dem& dem = input.dem();
  extent = FitCounted(sample, extent, input, placing);
  std::vector<FilePoint> points = sample.corners;
  points.insert(points.end(), sample.extremes.begin(), sample.extremes.end());
  Result<std::vector<GridPoint>> placed = PlaceOnGrid(points, placing, input);
  if (!placed) return std::nullopt;
  FrameFit fit;
  fit.placing = placing;
  fit.extent = extent;
  fit.sample = *std::move(placed);
  fit.least = {kInfinity, kInfinity, kInfinity};
  fit.greatest = {-kInfinity, -kInfinity, -kInfinity};
  std::size_t inside = 0;
  for (const GridPoint& p : fit.sample) {
    if (!std::isfinite(p.column) || !std::isfinite(p.row) || !std::isfinite(p.height_m)) {
      return std::nullopt;
    }
    fit.least = {std::min(fit.least.column, p.column), std::min(fit.least.row, p.row),
                 std::min(fit.least.height_m, p.height_m)};
    fit.greatest = {std::max(fit.greatest.column, p.column), std::max(fit.greatest.row, p.row),
                    std::max(fit.greatest.height_m, p.height_m)};
    const bool within =
        p.column >= -1 && p.row >= -1 && p.column <= dem.columns && p.row <= dem.rows;
    inside += within ? 1 : 0;
  }
  fit.inside = static_cast<double>(inside) / static_cast<double>(fit.sample.size());
  const double width =
      std::min(fit.greatest.column, dem.columns - 1.0) - std::max(fit.least.column, 0.0);
  const double height = std::min(fit.greatest.row, dem.rows - 1.0) - std::max(fit.least.row, 0.0);
  fit.coverage =
      std::max(width, 0.0) * std::max(height, 0.0) / ((dem.columns - 1.0) * (dem.rows - 1.0));
  fit.sample.resize(sample.corners.size());
  fit.correlation = CorrelationWithDem(fit.sample, dem);
  return fit;
}

bool OnOnePlan(const FrameFit& a, const FrameFit& b, const Dem& dem) {
  const double most = 0.03 * std::max(dem.columns, dem.rows);
  return std::ranges::equal(a.sample, b.sample, [most](const GridPoint& p, const GridPoint& q) {
    return std::hypot(p.column - q.column, p.row - q.row) <= most;
  });
}

}  // namespace farhorizon
