#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/io/mesh_files/file_mesh.h"
#include "core/pipeline/compare/mesh_frame.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// How the coordinates of a file's mesh become columns, rows and heights.
///
/// column_m, row_m: what a step of the DEM is in the file, and origin: where its corner or middle
///   is, for the frames in metres from there. height_offset_m: is added to the heights.
struct MeshPlacing {
  MeshFrame frame = MeshFrame::kCrs;
  UpAxis up = UpAxis::kZ;
  double column_m = 1;
  double row_m = 1;
  std::array<double, 2> origin = {0, 0};
  double height_offset_m = 0;
};

/// The point with z up.
FilePoint ZUp(const FilePoint& p, UpAxis up);

/// The steps of a DEM in metres, for frames that are counted in them: those of its map where that
/// is no map of degrees, otherwise those on the ground in its middle.
std::array<double, 2> NominalSteps(const TerrainInput& input);

/// The points in the frame of the grid. Errors: those of Georeference::ToGrid and ToEnu.
Result<std::vector<GridPoint>> PlaceOnGrid(const std::vector<FilePoint>& points,
                                           const MeshPlacing& placing, const TerrainInput& input);

/// The points in Georeference::frame, by way of the frame itself.
/// Requires: IsStraightOnGlobe(placing.frame).
std::vector<Enu> PlaceInTileFrame(const std::vector<FilePoint>& points, const MeshPlacing& placing,
                                  const TerrainInput& input);

}  // namespace farhorizon
