#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/pipeline/artifact_writer.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/level_artifact.h"
#include "core/pipeline/level_edges.h"
#include "core/pipeline/level_plan.h"
#include "core/pipeline/level_tree.h"
#include "core/pipeline/report_page/report_page.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/terrain_tiles/terrain_tiles.h"

namespace farhorizon {

/// The levels as they were written, the finest first.
///
/// edges, contents: what is drawn of their skylines, and their GLBs, where they are asked for.
/// globe: for the tiles of quantized-mesh, likewise.
struct WrittenLevels {
  std::vector<LevelReport> reports;
  std::vector<LevelEdges> edges;
  std::vector<std::vector<TileContentRegion>> contents;
  std::vector<TiledLevel> globe;
};

/// Encodes the levels of a chain, measures what they decode to, and writes the files that are asked
/// for. `page` gets the pictures.
/// Errors: those of EncodeLevel, PlaceLevel, FindLevelEdges, MeasureAll, LevelGlbs, PlaceOnGlobe
///   and the writer.
Result<WrittenLevels> WriteLevels(const LevelContext& context, const TerrainInput& input,
                                  const LevelPlan& plan, const std::vector<Lod>& chain,
                                  const BuildOptions& options, ArtifactWriter& writer,
                                  ReportPage& page);

}  // namespace farhorizon
