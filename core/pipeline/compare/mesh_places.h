#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/compare/covered_part.h"
#include "core/pipeline/compare/mesh_frame.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// The posts of a DEM, and of parts of it, in the frames in which meshes are straight.
class MeshPlaces {
 public:
  /// Requires: `input` outlives it.
  explicit MeshPlaces(const TerrainInput& input) : input_(&input) {}

  /// For a mesh of `frame`; part: what it covers, nullptr for the whole.
  /// Errors: those of FindPostPlaces. Cost: the first on the globe places all posts of the DEM.
  Result<PostPlaces> For(MeshFrame frame, const CoveredPart* part);

 private:
  const TerrainInput* input_;
  std::optional<PostPlaces> on_globe_;
};

}  // namespace farhorizon
