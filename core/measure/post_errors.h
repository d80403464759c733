#pragma once

#include <cstdint>
#include <vector>

#include "core/measure/mesh_error.h"
#include "core/measure/mesh_sides.h"

namespace farhorizon {

/// What a mesh is at each post of a DEM.
///
/// rise: the mesh's height less the post's, in the frame of the grid, metres; minus infinity where
///   no triangle has the post in plan. Rounded to floats: right to 1e-7 of itself.
struct PostErrors {
  ErrorMeasure vertical;
  double covered_share = 0;
  std::int64_t covered_twice = 0;
  std::vector<float> rise;
};

/// Measures a mesh at the posts, as MeshError::vertical has it.
///
/// is_vertex: of each post, whether it is part of the terrain.
/// Requires: places and mesh.straight are given both or neither.
/// Errors: kUnsupportedData, kind "bad-mesh", where no post is covered; kCancelled.
/// Cost: O(posts + triangles + outline), and a few steps more for a post whose vertical meets
///   another triangle than the plan says.
Result<PostErrors> MeasurePosts(const Terrain& terrain, const std::vector<std::uint8_t>& is_vertex,
                                const PostPlaces& places, const PlacedMesh& mesh,
                                const MeshSides& sides, const RunControl& control);

}  // namespace farhorizon
