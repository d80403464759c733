#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/io/draco_mesh.h"

namespace farhorizon {

/// A glTF 2.0 binary around a Draco bitstream (KHR_draco_mesh_compression), z up in the local frame
/// turned to glTF's y up by the root node.
///
/// decoded: what `draco` decodes to, in its own order; accessors' counts, min and max are its.
/// horizon_edges: pairs of positions in `decoded` (vertex indices) that are horizon edges, flagged in
/// EXT_mesh_primitive_edge_visibility: as silhouette edges between two triangles, as hard ones on
/// the border. The extension is left out where there are none.
/// CesiumJS 1.140 and 1.145 show these edges in the wrong place (seen in a browser): it dequantises
/// them itself and again in its shader. The terrain itself, and what the file says, are right.
/// The sources stay in the Draco bitstream, but are no attribute of the glTF primitive.
std::vector<std::uint8_t> WriteGlb(
    const std::vector<std::uint8_t>& draco, const LocalMesh& decoded,
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& horizon_edges);

/// The Draco bitstream inside a GLB that WriteGlb made, with the accessors' claims, for
/// verification.
struct GlbContents {
  std::vector<std::uint8_t> draco;
  std::int64_t vertex_count = 0;
  std::int64_t index_count = 0;
  std::array<double, 3> min = {0, 0, 0};
  std::array<double, 3> max = {0, 0, 0};
};
/// Errors: kUnsupportedData, kind "bad-glb", with the cause.
Result<GlbContents> ReadGlb(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
