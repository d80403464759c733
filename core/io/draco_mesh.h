#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frames.h"

namespace farhorizon {

/// The positions that one level's vertices may take: origin + step * {0 … 2^bits - 1} on each axis.
/// step is a power of two and origin a multiple of it, so that decoding is exact in float.
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

/// The greatest source. libdraco 1.5.5 takes time in proportion to the greatest difference between
/// neighbours (1.5 s at 2^28), and beyond 2^30 comes back with other numbers without a word.
inline constexpr std::uint32_t kMaxSource = (1U << 28U) - 1;

/// Triangles with positions in the local frame, metres. sources: per vertex, what it stands for (the
/// caller's number, carried through the encoding without loss).
struct LocalMesh {
  std::vector<Enu> positions;
  std::vector<std::uint32_t> sources;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A Draco bitstream (2.2, edgebreaker) with attribute 0 POSITION, quantised on `lattice`, and
/// attribute 1 GENERIC, the sources. Same mesh, same bytes.
///
/// Decoding gives the same triangles in another order, each with its winding. Vertices come in
/// another order too; one at which fans of triangles meet without sharing an edge comes once a fan.
/// Requires: positions lie on or within the lattice; as many sources as positions.
/// Errors: kUnsupportedData, kind "bad-mesh", where the mesh is empty, a triangle names a vertex
///   twice or one that is not there, a vertex is in no triangle, a source is beyond kMaxSource, or
///   libdraco refuses.
Result<std::vector<std::uint8_t>> EncodeDraco(const LocalMesh& mesh,
                                              const QuantizationLattice& lattice);

/// Errors: kUnsupportedData, kind "bad-draco", where the bytes are no such bitstream.
Result<LocalMesh> DecodeDraco(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
