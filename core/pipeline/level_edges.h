#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/io/draco_mesh.h"
#include "core/io/horizon_features.h"
#include "core/io/line_chains.h"
#include "core/io/quantization_lattice.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/report.h"

namespace farhorizon {

struct LevelContext;

/// "lod0-horizon.glb".
std::string HorizonGlbName(int level);

/// Pairs of a mesh's vertices.
using VertexPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// The edges of a level that are drawn as its horizon: the DEM's horizon edges that it has, and the
/// others that have the level's own skyline on them.
///
/// lines: by rising posts; their measures are those of the DEM once AddMeasures has been called.
/// vertices: the same edges by the vertices of the decoded mesh; of a post with several the first.
/// horizon_edges: for each line its place in the horizon, -1 where the DEM has no such edge there.
/// lattice: the level's.
struct LevelEdges {
  std::vector<HorizonLine> lines;
  VertexPairs vertices;
  std::vector<std::int32_t> horizon_edges;
  QuantizationLattice lattice;
  SkylineEdgesReport report;
};

/// A level's mesh as it was decoded, with posts, and as it is measured.
struct DecodedLevel {
  const DecodedMesh& decoded;
  const PlacedMesh& placed;
};

/// kept: places in the horizon of the edges that the level has. threads: never changes the result.
/// Errors: kCancelled; those of WeldedMesh and Georeference::StepsAt. Cost: FindOwnSkyline's.
Result<LevelEdges> FindLevelEdges(const LevelContext& context,
                                  const std::vector<std::int32_t>& kept, const DecodedLevel& level,
                                  int threads);

/// Puts the weights of the DEM's horizon edges, and their azimuths beside those that the level's
/// own skyline has shown, into the lines of a level. features: one for each edge of the horizon.
void AddMeasures(const std::vector<HorizonFeature>& features, LevelEdges& edges);

}  // namespace farhorizon
