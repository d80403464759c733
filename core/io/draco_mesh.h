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

/// The coarsest lattice over `points` whose step is at most `wanted_step_m`, in at most 16 bits
/// (CesiumJS reads no more); a coarser one where the extent asks for it.
QuantizationLattice ChooseLattice(const std::vector<Enu>& points, double wanted_step_m);

/// Triangles with positions in the local frame, metres. source: per vertex, what it stands for (the
/// caller's number, carried through the encoding without loss).
struct LocalMesh {
  std::vector<Enu> positions;
  std::vector<std::uint32_t> sources;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A Draco bitstream (2.2, edgebreaker) with attribute 0 POSITION, quantised on `lattice`, and
/// attribute 1 GENERIC, the sources. Same mesh, same bytes.
/// Errors: kUnsupportedData where libdraco refuses the mesh.
Result<std::vector<std::uint8_t>> EncodeDraco(const LocalMesh& mesh,
                                              const QuantizationLattice& lattice);

/// Errors: kUnsupportedData where the bytes are no such bitstream.
Result<LocalMesh> DecodeDraco(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
