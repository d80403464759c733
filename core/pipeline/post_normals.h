#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/io/local_mesh.h"
#include "core/pipeline/georeference.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The terrain's smooth normal at each post, in the local frame: east, north, up, of length 1;
/// zeros at posts that are no vertices. Floats, because there may be 64 million posts.
using PostNormals = std::vector<std::array<float, 3>>;

/// The mean of the normals of the faces around each post, weighted by area. A normal whose `up` is
/// below kLeastNormalUp is raised to it.
/// Errors: those of Georeference::ToEnu. Cost: O(posts).
Result<PostNormals> FindPostNormals(const Terrain& terrain, const Georeference& georeference);

/// The normals that light a mesh: at each vertex the mean of the terrain's normals over the posts
/// of the vertex's triangles, each post weighted by the square of the vertex's barycentric
/// coordinate there. The terrain's normal at the vertex alone would spread what one post happens to
/// be over triangles of hundreds of posts.
///
/// Vertices of one post get one normal; mesh.normals is not read. The result fits EncodeDraco.
/// Cost: O(posts + vertices).
std::vector<UnitNormal> MeanNormals(const Terrain& terrain, const PostNormals& normals,
                                    const LocalMesh& mesh);

}  // namespace farhorizon
