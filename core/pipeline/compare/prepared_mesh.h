#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/io/mesh_files/file_mesh.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/compare/choose_placing.h"
#include "core/pipeline/compare/compare.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// A mesh on a DEM's grid, its skirts left out, counter-clockwise: what is measured.
///
/// heights: over the DEM's posts (HeightsOverPosts). assumed: the placing, which is neither the
/// file's nor the call's.
struct PreparedMesh {
  MeshPlacing placing;
  bool assumed = false;
  PlacedMesh mesh;
  std::vector<double> heights;
};

/// Places and tidies a mesh, checks that its heights can be the DEM's, and sets all of `about`
/// except what is measured.
/// Errors: those of ChoosePlacing, PlaceOnGrid, HeightsOverPosts and CheckHeights; kind
///   "mesh-elsewhere" where it covers no post.
Result<PreparedMesh> PrepareMesh(const FileMesh& file, const StatedPlacing& stated,
                                 const TerrainInput& input, MeshComparison& about,
                                 const RunControl& control);

}  // namespace farhorizon
