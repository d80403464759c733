// Every frame is tried with either axis up on a sample of the mesh (frame_fit.h). Among those in
// which it lies within the DEM's box, the best is the one whose heights follow the DEM's; others
// that follow about as well compete with it, except where they cover far less of the DEM: a mesh in
// posts is also a mesh of a few metres in a corner. Frames that differ by little, such as metres
// over the map and metres in a tangent plane, do not compete: the better one is taken. What cannot
// be told is whether a mesh is turned or mirrored, where the ground is level or symmetric.
#include "core/pipeline/compare/choose_placing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "core/io/geojson_text.h"
#include "core/pipeline/compare/frame_fit.h"

namespace farhorizon {

namespace {

// A wrong frame usually has a misfit of 0.7 and more, the right one below 0.3 down to the coarsest
// level: a factor and a margin that rounding and coarse meshes do not exceed.
constexpr double kAsGoodFactor = 1.5;
constexpr double kAsGoodMargin = 0.05;
constexpr double kAsMuchCovered = 0.5;
constexpr double kFollows = 0.5;
constexpr double kClearly = 1.25;
constexpr double kClearMargin = 0.01;
// A hundred times the root of what double leaves of 1 - correlation^2.
constexpr double kRounding = 1e-6;

std::string Span(double from, double to) { return Rounded(from, 1) + " to " + Rounded(to, 1); }

std::string BoxOf(const FrameFit& fit) {
  return "columns " + Span(fit.least.column, fit.greatest.column) + ", rows " +
         Span(fit.least.row, fit.greatest.row) + ", heights " +
         Span(fit.least.height_m, fit.greatest.height_m);
}

std::string BoxOf(const Dem& dem) {
  return "columns 0 to " + std::to_string(dem.columns - 1) + ", rows 0 to " +
         std::to_string(dem.rows - 1);
}

std::string AxisText(const MeshPlacing& placing) {
  if (placing.frame == MeshFrame::kEcef) return "";
  return placing.up == UpAxis::kY ? ", y up" : ", z up";
}

std::string NameOf(const MeshPlacing& placing) {
  if (placing.frame == MeshFrame::kEcef) return "--mesh-frame ecef";
  return std::string("--mesh-frame ") + MeshFrameName(placing.frame) +
         (placing.up == UpAxis::kY ? " --mesh-up y" : " --mesh-up z");
}

// What may be tried.
struct Choice {
  std::vector<MeshFrame> frames;
  std::vector<UpAxis> axes;
  double height_offset_m;
};

// The fits of all frames that may be, in which the sample has a place.
std::vector<FrameFit> FitAll(const MeshSample& sample, const Choice& choice, Extent extent,
                             const TerrainInput& input) {
  const auto [column_m, row_m] = NominalSteps(input);
  std::vector<FrameFit> fits;
  for (const UpAxis up : choice.axes) {
    for (const MeshFrame frame : choice.frames) {
      // Earth-fixed coordinates have no axis that is up.
      if (frame == MeshFrame::kEcef && up == UpAxis::kY && choice.axes.size() > 1) continue;
      std::optional<FrameFit> fit = FitFrame(
          sample, {frame, up, column_m, row_m, {0, 0}, choice.height_offset_m}, extent, input);
      if (fit) fits.push_back(*std::move(fit));
    }
  }
  return fits;
}

// What fits are ordered by. Frames that are one, such as degrees by two names, differ by rounding:
// the first is taken. A box laid on the DEM's must follow clearly better than a frame with a place.
double Rank(const FrameFit& fit) {
  const bool laid = fit.extent == Extent::kWhole;
  return std::round((laid ? kClearly * fit.Misfit() + kClearMargin : fit.Misfit()) / kRounding);
}

// Whether coordinates of this frame say a place, on the map or on the globe.
bool SaysPlace(MeshFrame frame) {
  return frame == MeshFrame::kCrs || frame == MeshFrame::kLonLat || frame == MeshFrame::kEcef;
}

// The fit whose heights follow the DEM's best, first; then those that follow about as well on
// another plan. None where the mesh lies on the DEM in no frame.
std::vector<FrameFit> Best(const std::vector<FrameFit>& fits, const Dem& dem) {
  std::vector<FrameFit> best;
  std::ranges::copy_if(fits, std::back_inserter(best), &FrameFit::Lies);
  // A mesh that says its place and follows there has the error of that place, such as half a cell:
  // its box is not moved onto the DEM's.
  const bool at_home = std::ranges::any_of(best, [](const FrameFit& fit) {
    return fit.extent == Extent::kStated && SaysPlace(fit.placing.frame) &&
           fit.Misfit() <= kFollows;
  });
  if (at_home) std::erase_if(best, [](const FrameFit& f) { return f.extent == Extent::kWhole; });
  if (best.empty()) return best;
  const double least = std::ranges::min(best, {}, &FrameFit::Misfit).Misfit();
  std::erase_if(best, [&](const FrameFit& fit) {
    return fit.Misfit() > kAsGoodFactor * least + kAsGoodMargin;
  });
  const double most = std::ranges::max(best, {}, &FrameFit::coverage).coverage;
  std::erase_if(best, [&](const FrameFit& fit) { return fit.coverage < kAsMuchCovered * most; });
  std::ranges::stable_sort(best, {}, Rank);
  // A place that fits is no accident; a box that is laid on the DEM's always fits.
  if (best.front().extent == Extent::kStated) {
    std::erase_if(best, [](const FrameFit& fit) { return fit.extent == Extent::kWhole; });
  }
  std::vector<FrameFit> apart;
  for (const FrameFit& fit : best) {
    const bool known = std::ranges::any_of(
        apart, [&](const FrameFit& other) { return OnOnePlan(fit, other, dem); });
    if (!known) apart.push_back(fit);
  }
  return apart;
}

Error Elsewhere(const FileMesh& mesh, const std::vector<FrameFit>& fits,
                const TerrainInput& input) {
  std::string text;
  if (fits.size() == 1) {
    const FrameFit& fit = fits.front();
    const auto [column_m, row_m] =
        std::array{input.georeference().column_step_m(), input.georeference().row_step_m()};
    const double columns =
        (fit.least.column + fit.greatest.column) / 2 - (input.dem().columns - 1) / 2.0;
    const double rows = (fit.least.row + fit.greatest.row) / 2 - (input.dem().rows - 1) / 2.0;
    text = "the mesh does not lie on the DEM: as " +
           std::string(MeshFrameMeaning(fit.placing.frame)) + AxisText(fit.placing) + " it has " +
           BoxOf(fit) + ", the DEM " + BoxOf(input.dem()) + "; its middle is " +
           Rounded(columns * column_m, 1) + " m along the rows and " + Rounded(rows * row_m, 1) +
           " m down the columns from the DEM's";
  } else {
    FilePoint least = mesh.points.front();
    FilePoint most = least;
    for (const FilePoint& p : mesh.points) {
      for (std::size_t k = 0; k < 3; ++k) {
        least[k] = std::min(least[k], p[k]);
        most[k] = std::max(most[k], p[k]);
      }
    }
    const auto [column_m, row_m] = NominalSteps(input);
    const Dem& dem = input.dem();
    const double x = dem.transform.origin_x;
    const double y = dem.transform.origin_y;
    text = "the mesh does not lie on the DEM in any frame that is known: its points have x from " +
           Span(least[0], most[0]) + ", y from " + Span(least[1], most[1]) + ", z from " +
           Span(least[2], most[2]) + "; the DEM has " + std::to_string(dem.columns) + " x " +
           std::to_string(dem.rows) + " posts, " + Rounded((dem.columns - 1) * column_m, 1) +
           " x " + Rounded((dem.rows - 1) * row_m, 1) + " m, on its map x from " +
           Span(x, x + (dem.columns - 1) * dem.transform.step_x) + ", y from " +
           Span(y, y + (dem.rows - 1) * dem.transform.step_y);
  }
  return {ErrorCode::kUnsupportedData, text + "; --mesh-frame and --mesh-up state a frame",
          "mesh-elsewhere"};
}

Error Ambiguous(const std::vector<FrameFit>& best) {
  std::string names;
  for (const FrameFit& fit : best) names += (names.empty() ? "" : ", or ") + NameOf(fit.placing);
  return {ErrorCode::kInvalidArgument,
          "the mesh says no place, and lies on the DEM about as well in " +
              std::to_string(best.size()) + " ways; state which: " + names,
          "mesh-frame"};
}

std::vector<MeshFrame> FramesFor(const FileMesh& mesh, const StatedPlacing& stated) {
  if (stated.frame) return {*stated.frame};
  if (mesh.frame == FileFrame::kEcef) return {MeshFrame::kEcef};
  if (mesh.frame == FileFrame::kTile) return {MeshFrame::kTile};
  return AllMeshFrames();
}

std::vector<UpAxis> AxesFor(const FileMesh& mesh, const StatedPlacing& stated) {
  if (stated.up) return {*stated.up};
  if (mesh.frame == FileFrame::kEcef || mesh.frame == FileFrame::kTile) return {UpAxis::kZ};
  if (mesh.frame == FileFrame::kYUp) return {UpAxis::kY, UpAxis::kZ};
  return {UpAxis::kZ, UpAxis::kY};
}

}  // namespace

Result<ChosenPlacing> ChoosePlacing(const FileMesh& mesh, const StatedPlacing& stated,
                                    const TerrainInput& input) {
  const MeshSample sample = SampleOf(mesh);
  const Choice choice = {FramesFor(mesh, stated), AxesFor(mesh, stated), stated.height_offset_m};
  const std::vector<FrameFit> fits = FitAll(sample, choice, Extent::kStated, input);
  // Cells of another size than the DEM's, such as squares for degrees, or another origin: heights
  // must tell, or the call.
  Choice from_corner = choice;
  std::erase_if(from_corner.frames, [](MeshFrame frame) {
    return frame != MeshFrame::kCorner && frame != MeshFrame::kCornerDown;
  });
  std::vector<FrameFit> laid = FitAll(sample, from_corner, Extent::kWhole, input);
  std::erase_if(laid, [&](const FrameFit& fit) {
    return fit.extent != Extent::kWhole || (!stated.frame && fit.Misfit() > kFollows);
  });
  std::vector<FrameFit> all = fits;
  const bool placed = stated.frame && std::ranges::any_of(fits, &FrameFit::Lies);
  if (!placed) all.insert(all.end(), laid.begin(), laid.end());
  std::vector<FrameFit> best = Best(all, input.dem());
  if (best.empty()) return Elsewhere(mesh, fits, input);
  const auto y_up = [](const FrameFit& fit) { return fit.placing.up == UpAxis::kY; };
  if (mesh.frame == FileFrame::kYUp && std::ranges::any_of(best, y_up)) {
    std::erase_if(best, std::not_fn(y_up));
  }
  if (best.size() > 1) return Ambiguous(best);
  ChosenPlacing chosen;
  chosen.placing = best.front().placing;
  const bool by_file = mesh.frame == FileFrame::kEcef || mesh.frame == FileFrame::kTile;
  chosen.assumed = !by_file && !(stated.frame && stated.up);
  chosen.text = "the mesh's coordinates are " + std::string(chosen.assumed ? "taken for " : "") +
                MeshFrameMeaning(chosen.placing.frame) + AxisText(chosen.placing);
  const auto [column_m, row_m] = NominalSteps(input);
  const MeshPlacing& p = chosen.placing;
  if (p.column_m != 1 && (p.column_m != column_m || p.row_m != row_m)) {
    chosen.text += ", reaching from side to side: a cell is " + Rounded(p.column_m, 3) + " x " +
                   Rounded(p.row_m, 3) + " of its metres";
  }
  if (p.origin[0] != 0 || p.origin[1] != 0) {
    chosen.text += ", counted from x " + Rounded(p.origin[0], 3) + " and y " +
                   Rounded(p.origin[1], 3) + ", where its box begins";
  }
  if (chosen.assumed) chosen.text += ", in which it fits the DEM; --mesh-frame states it otherwise";
  return chosen;
}

}  // namespace farhorizon
