#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/io/local_mesh.h"
#include "core/io/quantization_lattice.h"

namespace farhorizon {

/// How far upwards the normals of ground point at least, as a cosine: 1.8 degrees above the
/// horizontal. Draco's octahedron of 8 bits turns a normal by less than a degree, so that decoded
/// ones point upwards, too.
inline constexpr double kLeastNormalUp = 1.0 / 32;

/// The greatest number of a post. libdraco 1.5.5 takes time in proportion to the greatest
/// difference between the numbers of neighbours (1.5 s at 2^28), and beyond 2^30 decodes other
/// numbers without an error.
inline constexpr std::uint32_t kMaxPost = (1U << 28U) - 1;

/// The unique ids of the attributes of our bitstreams.
inline constexpr int kDracoPositionId = 0;
inline constexpr int kDracoPostId = 1;
inline constexpr int kDracoNormalId = 2;

/// Whether a bitstream has the vertices' posts: a fifth of its bytes.
enum class DracoPosts { kWritten, kLeftOut };

/// Encodes a mesh as a Draco bitstream (2.2, edgebreaker). Attributes, by unique id: 0 POSITION,
/// lattice numbers, from 0 to 2^bits - 1, as floats; 1 GENERIC, the posts, where they are written;
/// 2 NORMAL, on Draco's octahedron in 8 bits, less than a degree off. Same mesh, same bytes.
///
/// A point in metres is origin + step * number. The bitstream's geometry metadata has these four
/// doubles as lattice_origin_east, lattice_origin_north, lattice_origin_up and lattice_step
/// (draco3d's MetadataQuerier reads single doubles only). They are not Draco's own quantisation,
/// whose origin is 0 and step 1, because CesiumJS 1.140 to 1.145 applies that twice to horizon
/// edges (EdgeVisibilityPipelineStage.js reads positions that are placed already, and draws them
/// with the shader that places); applying the identity twice does no harm.
///
/// Decoding gives the same triangles in another order, each with its winding. Vertices come in
/// another order, too; a vertex at which fans of triangles meet without a shared edge comes once
/// for each fan.
/// Requires: positions lie on or within the lattice; as many posts and normals as positions;
///   normals of length 1.
/// Errors: kUnsupportedData, kind "bad-mesh", where the mesh is empty, a triangle names a vertex
///   twice or one that does not exist, a vertex is in no triangle, a post is beyond kMaxPost, or
///   libdraco refuses.
Result<std::vector<std::uint8_t>> EncodeDraco(const LocalMesh& mesh,
                                              const QuantizationLattice& lattice,
                                              DracoPosts posts = DracoPosts::kWritten);

/// What a bitstream holds. mesh: positions in metres; no posts where they were left out. lattice:
/// origin and step from the metadata, as few bits as hold the positions.
struct DecodedMesh {
  LocalMesh mesh;
  QuantizationLattice lattice;
};

/// Decodes the bytes of EncodeDraco. Errors: kUnsupportedData, kind "bad-draco", for other bytes.
Result<DecodedMesh> DecodeDraco(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
