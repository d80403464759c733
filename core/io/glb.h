#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/io/draco_mesh.h"

namespace farhorizon {

/// From lattice numbers to glTF's frame, column-major: metres in the local frame, whose z up is turned
/// to glTF's y up. 3D Tiles turns it back, so that the local frame arrives as it is (3D Tiles 1.1,
/// "glTF transforms"). Exact in float for lattices that ChooseLattice chose.
std::array<double, 16> GltfMatrix(const QuantizationLattice& lattice);

/// A glTF 2.0 binary around a Draco bitstream (KHR_draco_mesh_compression) of lattice numbers, which
/// the root node's matrix places (GltfMatrix).
///
/// decoded: what `draco` decodes to, in its own order; accessors' counts, min and max are its, in
/// lattice numbers.
/// horizon_edges: pairs of vertices of `decoded` that are horizon edges, flagged in
/// EXT_mesh_primitive_edge_visibility: as silhouette edges between two triangles, as hard ones on
/// the border. The extension is left out where there are none.
/// The sources stay in the Draco bitstream, but are no attribute of the glTF primitive.
std::vector<std::uint8_t> WriteGlb(
    const std::vector<std::uint8_t>& draco, const DecodedMesh& decoded,
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& horizon_edges);

/// The Draco bitstream inside a GLB that WriteGlb made, with what accessors and the root node claim of
/// it, for verification.
struct GlbContents {
  std::vector<std::uint8_t> draco;
  std::int64_t vertex_count = 0;
  std::int64_t normal_count = 0;
  std::int64_t index_count = 0;
  std::array<double, 3> min = {0, 0, 0};
  std::array<double, 3> max = {0, 0, 0};
  std::array<double, 16> matrix = {};
};
/// Errors: kUnsupportedData, kind "bad-glb", with the cause.
Result<GlbContents> ReadGlb(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
