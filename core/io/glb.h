#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/io/draco_mesh.h"
#include "core/io/edge_visibility.h"

namespace farhorizon {

/// The matrix from lattice numbers to glTF's frame, column-major: metres in the local frame, turned
/// from z up to glTF's y up. 3D Tiles turns it back ([3D Tiles], "glTF transforms").
/// Exact in float where ExactInFloat holds.
std::array<double, 16> GltfMatrix(const QuantizationLattice& lattice);

/// A glTF 2.0 binary around a Draco bitstream of lattice numbers [KHR_draco_mesh_compression], with
/// GltfMatrix on the root node.
///
/// decoded: what `draco` decodes to. Accessors have its counts, and its least and greatest
///   positions in lattice numbers.
/// horizon_edges: pairs of vertices of `decoded`, flagged as FlagEdges says
///   [EXT_mesh_primitive_edge_visibility]. The extension is left out where there are none.
/// Posts are no attribute of the glTF primitive.
std::vector<std::uint8_t> WriteGlb(
    const std::vector<std::uint8_t>& draco, const DecodedMesh& decoded,
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& horizon_edges);

/// The Draco bitstream in a GLB of WriteGlb, and what accessors and root node claim of it, for
/// verification. min, max: lattice numbers. edges: those of the extension, uncounted; empty where
/// there is none.
struct GlbContents {
  std::vector<std::uint8_t> draco;
  std::int64_t vertex_count = 0;
  std::int64_t normal_count = 0;
  std::int64_t index_count = 0;
  std::array<double, 3> min = {0, 0, 0};
  std::array<double, 3> max = {0, 0, 0};
  std::array<double, 16> matrix = {};
  EdgeVisibility edges;
};
/// Errors: kUnsupportedData, kind "bad-glb", with the cause.
Result<GlbContents> ReadGlb(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
