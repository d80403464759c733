#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/io/local_mesh.h"
#include "core/pipeline/georeference.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The terrain's smooth normal at each post, along the axes of the local frame, of length 1; zeros
/// at posts that are no vertices. Floats, because there may be 64 million posts.
///
/// around: of the posts of tile and apron, row by row; columns: in such a row.
struct PostNormals {
  int apron = 0;
  std::int32_t columns = 0;
  std::vector<std::array<float, 3>> around;

  /// By column and row of the tile; they may lie in the apron.
  [[nodiscard]] const std::array<float, 3>& At(std::int64_t column, std::int64_t row) const {
    return around[static_cast<std::size_t>((row + apron) * columns + column + apron)];
  }
};

/// The mean of the normals of the faces around each post, weighted by area. A normal that points
/// upwards, along the ellipsoid's normal, by less than kLeastNormalUp is raised to it.
/// around: the terrain with `apron` rows and columns on each side. georeference: of the tile.
/// Errors: those of Georeference::ToEnu. Cost: O(posts).
Result<PostNormals> FindPostNormals(const Terrain& around, const Georeference& georeference,
                                    int apron = 0);

/// How many posts to each side light a vertex on a side of a level: as far as the vertices of such
/// a level are from one another inside, and as far as the apron has whole faces all around.
///
/// Level 0 by size has every fifth triangle, so a vertex for each ten of both triangles of a cell:
/// they are 2 cells apart, half of which is taken; each further level's are 1.58 times as far.
/// coarseness: as StepsOfLevel has `number`, alike in neighbours. 0 where there is no apron.
int SeamReach(int apron, int coarseness);

/// The normals that light a mesh: at each vertex the mean of the terrain's normals over the posts
/// of the vertex's triangles, each post weighted by the square of the vertex's barycentric
/// coordinate there. The terrain's normal at the vertex alone would spread what one post happens to
/// be over triangles of hundreds of posts.
///
/// With an apron, a vertex on one of the tile's four sides has the mean over the posts that are
/// `seam_reach` columns and rows from it at most, in the tile or not, by weights that fall
/// linearly: its neighbours' tiles have the same posts there, and so the same normal.
///
/// Vertices of one post get one normal, raised as those of posts are; mesh.normals is not read.
/// frame: of the mesh. Requires: seam_reach < normals.apron where that is not 0.
/// Cost: O(posts + vertices).
std::vector<UnitNormal> MeanNormals(const Terrain& terrain, const TangentFrame& frame,
                                    const PostNormals& normals, const LocalMesh& mesh,
                                    int seam_reach = 0);

}  // namespace farhorizon
