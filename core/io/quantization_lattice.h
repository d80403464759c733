#pragma once

#include <array>
#include <vector>

#include "core/geo/frames.h"

namespace farhorizon {

/// The positions that one level's vertices may have: origin + step_m * {0 … 2^bits - 1} on each
/// axis (east, north, up; metres in the local frame).
/// step_m is a power of two and origin a multiple of it, so that origin + step_m * number is exact.
struct QuantizationLattice {
  std::array<double, 3> origin = {0, 0, 0};
  double step_m = 1;
  int bits = 16;
};

/// The most bits of a lattice number.
///
/// Draco codes differences of up to 18 bits by their frequencies, and from 20 bits of position on a
/// mesh has some that are longer: then all are written out, 3/8 more bytes (measured at 576,000
/// triangles). Clients take more than 16: CesiumJS 1.145 reads numbers of more than 16 bits as
/// floats and applies Draco's transform to them (Workers/decodeDraco.js), which is the identity
/// here (draco_mesh.h).
inline constexpr int kMaxLatticeBits = 19;

/// The coarsest lattice over `points` whose step is at most `wanted_step_m`. The step is coarser
/// where kMaxLatticeBits would not reach over the points, or ExactInFloat would not hold.
/// Requires: wanted_step_m > 0, at least one point, all finite.
QuantizationLattice ChooseLattice(const std::vector<Enu>& points, double wanted_step_m);

/// True where float's 24 bits hold every position of `lattice` without rounding, as the matrices of
/// renderers compute it: step * number + origin.
bool ExactInFloat(const QuantizationLattice& lattice);

/// The position of `lattice` that is nearest to `point` (ties to even): what `point` decodes to.
Enu SnapToLattice(const Enu& point, const QuantizationLattice& lattice);

/// That position's number on each axis, counted from the lattice's origin: what the bitstream
/// holds. Exact. Requires: `point` lies on or within the lattice.
std::array<double, 3> LatticeNumbers(const Enu& point, const QuantizationLattice& lattice);

/// A box of lattice numbers.
struct LatticeBox {
  std::array<double, 3> least = {0, 0, 0};
  std::array<double, 3> greatest = {0, 0, 0};
};

/// The smallest box with the lattice numbers of all of `points`; zeros where there are none.
LatticeBox LatticeBoxOf(const std::vector<Enu>& points, const QuantizationLattice& lattice);

}  // namespace farhorizon
