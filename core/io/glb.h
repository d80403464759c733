#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/io/draco_mesh.h"
#include "core/io/edge_visibility.h"

namespace farhorizon {

/// The matrix from lattice numbers to glTF's frame, column-major: metres in the local frame, turned
/// from z up to glTF's y up. 3D Tiles turns it back ([3D Tiles], "glTF transforms").
/// Exact in float where ExactInFloat holds.
std::array<double, 16> GltfMatrix(const QuantizationLattice& lattice);

/// A Draco bitstream and what it decodes to.
struct EncodedMesh {
  std::vector<std::uint8_t> draco;
  DecodedMesh decoded;
};

/// A glTF 2.0 binary around a Draco bitstream of lattice numbers [KHR_draco_mesh_compression], with
/// GltfMatrix on the root node.
///
/// decoded: what `draco` decodes to. Accessors have its counts, and its least and greatest
///   positions in lattice numbers.
/// edges: what is flagged of its triangles' sides [EXT_mesh_primitive_edge_visibility]; without any
///   the extension is left out.
/// skirt: walls on the same lattice, a second primitive of the mesh with the same material, so that
/// renderers place a post of the rim bit for bit alike in both; its `extras` are {"skirt": true}.
/// Posts are no attribute of the glTF primitives.
std::vector<std::uint8_t> WriteGlb(const std::vector<std::uint8_t>& draco,
                                   const DecodedMesh& decoded, const EdgeVisibility& edges,
                                   const EncodedMesh* skirt = nullptr);

/// The Draco bitstream of a primitive of WriteGlb, and what its accessors claim of it. min, max:
/// lattice numbers.
struct GlbPrimitive {
  std::vector<std::uint8_t> draco;
  std::int64_t vertex_count = 0;
  std::int64_t normal_count = 0;
  std::int64_t index_count = 0;
  std::array<double, 3> min = {0, 0, 0};
  std::array<double, 3> max = {0, 0, 0};
};

/// A GLB of WriteGlb, for verification. matrix: of the root node. edges: those that the surface
/// flags, uncounted; empty where it flags none.
struct GlbContents {
  GlbPrimitive surface;
  std::optional<GlbPrimitive> skirt;
  std::array<double, 16> matrix = {};
  EdgeVisibility edges;
};
/// Errors: kUnsupportedData, kind "bad-glb", with the cause.
Result<GlbContents> ReadGlb(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
