#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frames.h"
#include "core/io/azimuth_mask.h"
#include "core/io/horizon_features.h"

namespace farhorizon {

/// Horizon edges one behind the other, as a line.
///
/// posts: [column, row], one more than edges; a post may be there more than once. line: their
///   positions. level_kept: of each edge. in_context, undecided: as all of its edges are.
/// azimuths: those of all its edges. line_measure_m: their sum. skyline_drop_m: their greatest.
/// sights, drop: whether all of its edges have these.
struct HorizonChain {
  std::vector<std::array<std::int32_t, 2>> posts;
  std::vector<Geodetic> line;
  std::vector<std::optional<int>> level_kept;
  AzimuthMask azimuths = 0;
  double line_measure_m = 0;
  double skyline_drop_m = 0;
  Known sights = Known::kYes;
  Known drop = Known::kYes;
  std::optional<bool> in_context;
  bool undecided = false;
};

/// Takes every edge once into as few chains as there can be, but closed ones: at each post edges
/// are joined by twos, the two that run straightest first, so that no more than one chain ends
/// there of each kind: undecided or not, in context or not. Chains that end come first, in the
/// order of their first edges.
/// Cost: O(n log n).
std::vector<HorizonChain> ChainsOf(const std::vector<HorizonFeature>& features);

/// The text of horizon.geojson in its compact form: a feature a chain, one to a line of text, with
/// the members `detail`, "chains", `edges`, their number, and `azimuths`, those of all chains, on
/// the collection.
///
/// Posts are not named: those of a chain are the nearest to its points, which are rounded to a 64th
/// of a cell of cell_m. levels_kept: a hexadecimal digit an edge, - for none; absent where no edge
/// has a level. Weights are rounded to four digits.
std::string WriteHorizonChains(const std::vector<HorizonChain>& chains, double cell_m);

/// By how much WriteHorizonChains may move a post: degrees of longitude and latitude, and metres.
struct ChainRounding {
  int degree_decimals = 0;
  int metre_decimals = 0;
};
ChainRounding RoundingOfChains(double cell_m);

/// Whether `text` is of WriteHorizonChains, by its head.
bool HasChains(const std::string& text);

/// Reads back the text of WriteHorizonChains; `posts` are left empty. Errors: kUnsupportedData,
/// kind "bad-geojson", with the feature and the cause.
Result<std::vector<HorizonChain>> ReadHorizonChains(const std::string& text);

}  // namespace farhorizon
