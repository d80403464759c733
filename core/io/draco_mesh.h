#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frames.h"

namespace farhorizon {

/// The positions that one level's vertices may take: origin + step * {0 … 2^bits - 1} on each axis.
/// step is a power of two and origin a multiple of it, so that placing a lattice number is exact.
struct QuantizationLattice {
  std::array<double, 3> origin = {0, 0, 0};
  double step_m = 1;
  int bits = 16;
};

/// The coarsest lattice over `points` whose step is at most `wanted_step_m`, in at most 16 bits; a
/// coarser one where the extent, or the distance from the frame's origin in float's 24 bits, asks
/// for it.
///
/// 16: CesiumJS 1.140 reads quantised attributes as Uint8Array up to 8 bits, as Uint16Array up to
/// 16, and beyond that as floats whose transform it told Draco to skip
/// (Workers/decodeDraco.js, decodeQuantizedDracoTypedArray).
/// Requires: wanted_step_m > 0, at least one point, all finite.
QuantizationLattice ChooseLattice(const std::vector<Enu>& points, double wanted_step_m);

/// `point` moved to the nearest position of `lattice` (ties to even): what it decodes to.
Enu SnapToLattice(const Enu& point, const QuantizationLattice& lattice);

/// Which position of `lattice` is nearest to `point` (ties to even), counted from its origin on each
/// axis: what the bitstream holds. Exact.
std::array<double, 3> LatticeNumbers(const Enu& point, const QuantizationLattice& lattice);

/// A direction in the local frame: east, north, up; of length 1.
using UnitNormal = std::array<double, 3>;

/// The least `up` of a vertex normal, 1.8 degrees: Draco's octahedron in kNormalBits moves a normal
/// by less, so that decoded ones point upwards too.
inline constexpr double kLeastNormalUp = 1.0 / 32;

/// The greatest source. libdraco 1.5.5 takes time in proportion to the greatest difference between
/// neighbours (1.5 s at 2^28), and beyond 2^30 comes back with other numbers without a word.
inline constexpr std::uint32_t kMaxSource = (1U << 28U) - 1;

/// Triangles with positions in the local frame, metres. sources: per vertex, what it stands for (the
/// caller's number, carried through the encoding without loss). normals: per vertex, of the surface
/// that the mesh stands for.
struct LocalMesh {
  std::vector<Enu> positions;
  std::vector<std::uint32_t> sources;
  std::vector<UnitNormal> normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A Draco bitstream (2.2, edgebreaker). Attribute 0 POSITION: lattice numbers, from 0 to
/// 2^bits - 1, as floats; 1 GENERIC: the sources; 2 NORMAL: on Draco's octahedron in 8 bits, less
/// than a degree off. Same mesh, same bytes.
///
/// A point in metres is origin + step * number. The four doubles are in the bitstream's geometry
/// metadata as lattice_origin_east, lattice_origin_north, lattice_origin_up and lattice_step
/// (draco3d's MetadataQuerier reads single doubles only). They are no part of Draco's own
/// quantisation, whose origin is 0 and step 1, because CesiumJS 1.140 to 1.145 applies that twice to
/// horizon edges (EdgeVisibilityPipelineStage.js reads positions that are placed already, and draws
/// them with the shader that places): twice the identity does no harm.
///
/// Decoding gives the same triangles in another order, each with its winding. Vertices come in
/// another order too; one at which fans of triangles meet without sharing an edge comes once a fan.
/// Requires: positions lie on or within the lattice; as many sources and normals as positions; normals
///   of length 1 with up >= kLeastNormalUp.
/// Errors: kUnsupportedData, kind "bad-mesh", where the mesh is empty, a triangle names a vertex
///   twice or one that is not there, a vertex is in no triangle, a source is beyond kMaxSource, or
///   libdraco refuses.
Result<std::vector<std::uint8_t>> EncodeDraco(const LocalMesh& mesh,
                                              const QuantizationLattice& lattice);

/// mesh: in metres. lattice: as the metadata has it, in as few bits as hold the positions.
struct DecodedMesh {
  LocalMesh mesh;
  QuantizationLattice lattice;
};

/// Errors: kUnsupportedData, kind "bad-draco", where the bytes are no such bitstream.
Result<DecodedMesh> DecodeDraco(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
