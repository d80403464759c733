#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/io/draco_mesh.h"
#include "core/pipeline/georeference.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The terrain's own smooth normal at each post, in the local frame: east, north, up, of length 1; zeros at
/// posts that are no vertices. Floats, because there may be 64 million.
using PostNormals = std::vector<std::array<float, 3>>;

/// The mean of the faces around each post, each by its area. A normal that leans lower than
/// kLeastNormalUp is raised to there.
/// Errors: those of placing posts. Cost: O(posts).
Result<PostNormals> FindPostNormals(const Terrain& terrain, const Georeference& georeference);

/// What to light each vertex of a mesh with: the mean of the terrain's normals over the vertex's
/// triangles, each post by the square of the vertex's share in it (its barycentric coordinate). With
/// the terrain's normal at the vertex alone, a coarse mesh would smear what one post happens to be
/// over triangles of hundreds.
///
/// mesh: sources are posts; vertices of one source get one normal. Its own normals are not read.
/// Returns normals as EncodeDraco wants them. Cost: O(posts + vertices).
std::vector<UnitNormal> MeanNormals(const Terrain& terrain, const PostNormals& normals,
                                    const LocalMesh& mesh);

}  // namespace farhorizon
