#pragma once

#include <optional>
#include <string>

#include "core/io/mesh_files/file_mesh.h"
#include "core/pipeline/compare/mesh_placing.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// What the call states of a mesh's coordinates; what is left out is found by fitting.
struct StatedPlacing {
  std::optional<MeshFrame> frame = {};
  std::optional<UpAxis> up = {};
  double height_offset_m = 0;
};

/// A placing, and a sentence for people: what was taken, and whether it was stated or found.
struct ChosenPlacing {
  MeshPlacing placing;
  bool assumed = false;  ///< neither the file nor the call says it
  std::string text;
};

/// How the coordinates of `mesh` are to be read: as stated; as its file says; otherwise the one of
/// all frames, with either axis up, in which the mesh lies on the DEM's box and its heights follow
/// the DEM's best. glTF's y is taken for up as long as that fits no worse. Metres from any other
/// corner are counted from where the mesh's box begins, and the text says it; what lies on the DEM
/// by coordinates of the map or the globe is not moved.
///
/// Errors: kUnsupportedData, kind "mesh-elsewhere", where it lies on the DEM in none, with where it
///   is; kInvalidArgument, kind "mesh-frame", where several fit about as well and differ.
Result<ChosenPlacing> ChoosePlacing(const FileMesh& mesh, const StatedPlacing& stated,
                                    const TerrainInput& input);

}  // namespace farhorizon
