#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace farhorizon {

/// What long work is at. The list is closed: progress, timings, a job's message and
/// proto/schemas/status-info.schema.json use these names and no others.
enum class Stage {
  kRead,          ///< reads the DEM, triangulates it and places it on the globe
  kSweep,         ///< sweeps a plane from the summit down and keeps the hulls of what is above it
  kCandidates,    ///< finds the edges that those hulls do not hide
  kKineticSweep,  ///< finds the horizon edges by kinetic hulls and their bitangents
  kDecide,        ///< decides each candidate exactly
  kSimplify,      ///< collapses edges, level after level
  kEncode,        ///< encodes a level and decodes it again
  kMeasure,       ///< measures the errors of a level
  kLinesOfSight,  ///< finds all lines of sight of each horizon edge
  kEdgeMeasures,  ///< measures each horizon edge: azimuths, spans and weights
  kWrite,         ///< makes and writes the files
  kVerify,        ///< compares claims with what was found again
};

inline constexpr std::array kStages = {
    Stage::kRead,         Stage::kSweep,        Stage::kCandidates, Stage::kKineticSweep,
    Stage::kDecide,       Stage::kSimplify,     Stage::kEncode,     Stage::kMeasure,
    Stage::kLinesOfSight, Stage::kEdgeMeasures, Stage::kWrite,      Stage::kVerify,
};
static_assert(kStages.size() == static_cast<std::size_t>(Stage::kVerify) + 1);

/// Lower-case words with hyphens: "lines-of-sight".
const char* StageName(Stage stage);

/// nullopt where no stage has this name.
std::optional<Stage> StageFromName(std::string_view name);

}  // namespace farhorizon
