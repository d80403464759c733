#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/io/line_chains.h"
#include "core/io/quantization_lattice.h"

namespace farhorizon {

/// What the two that write and read the binary agree on: a point, where views of the buffer may
/// begin [EXT_structural_metadata], and what stands for a measure that is unset.
using HorizonGlbPoint = std::array<float, 3>;
inline constexpr std::size_t kHorizonGlbAlignment = 8;
inline constexpr float kUnsetMeasure = -1;

/// A glTF 2.0 binary with a primitive of LINES, in the frame of the level's mesh: GltfMatrix of the
/// same lattice is on the root node.
///
/// A point is one vertex, however many edges meet there: lattice numbers of 16 bits
/// [KHR_mesh_quantization] where all of them are below 2^16, else floats. Indices have the edges of
/// one chain after the other. A table of EXT_structural_metadata has a row for each chain: `edges`,
/// how many of the primitive's lines are its, of the least unsigned type that has room for all;
/// `azimuths`, two UINT32, bits 0 to 31 of the mask first; `line_measure_m` and `skyline_drop_m`,
/// FLOAT32, -1 where they are unset.
/// Same chains, same bytes. Requires: at least one chain; each has two points or more.
std::vector<std::uint8_t> WriteHorizonGlb(const std::vector<LineChain>& chains,
                                          const QuantizationLattice& lattice);

}  // namespace farhorizon
