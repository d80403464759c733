#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/io/azimuth_mask.h"
#include "core/io/quantization_lattice.h"

namespace farhorizon {

/// An edge of a level that has the level's own skyline on it somewhere, as it is published.
///
/// ends: in numbers of the level's lattice, as its mesh has them. posts: their numbers in the DEM,
///   row * columns + column, rising.
/// azimuths: directions of sight in which the edge is on the skyline, rounded outwards to bits.
/// line_measure_m, skyline_drop_m: those of the DEM's horizon edge (EdgeMeasures); unset where the
///   edge is a chord of the level's own, or the measure is not known.
struct HorizonLine {
  std::array<std::array<float, 3>, 2> ends = {};
  std::array<std::uint32_t, 2> posts = {};
  AzimuthMask azimuths = 0;
  std::optional<float> line_measure_m;
  std::optional<float> skyline_drop_m;

  friend bool operator==(const HorizonLine&, const HorizonLine&) = default;
};

/// A glTF 2.0 binary with a primitive of LINES, two vertices a line in the given order, in the
/// frame of the level's mesh: GltfMatrix of the same lattice is on the root node.
///
/// Each line is a feature of EXT_mesh_features, its number the attribute _FEATURE_ID_0, with a row
/// in a table of EXT_structural_metadata: `posts`, two UINT32; `azimuths`, two UINT32, bits 0 to 31
/// of the mask first; `line_measure_m` and `skyline_drop_m`, FLOAT32, -1 where they are unset. The
/// table is left out of a file with more lines than floats can number, 2^24.
/// Same lines, same bytes. Requires: at least one line.
std::vector<std::uint8_t> WriteHorizonGlb(const std::vector<HorizonLine>& lines,
                                          const QuantizationLattice& lattice);

/// What a file of WriteHorizonGlb holds, for verification. has_table: without one, lines have ends
/// alone. in_box: whether all ends are within the bounds that the accessor claims.
struct HorizonGlbContents {
  std::vector<HorizonLine> lines;
  std::array<double, 16> matrix = {};
  bool has_table = false;
  bool in_box = false;
};
/// Errors: kUnsupportedData, kind "bad-glb", with the cause.
Result<HorizonGlbContents> ReadHorizonGlb(const std::vector<std::uint8_t>& bytes);

}  // namespace farhorizon
