#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/io/local_mesh.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/level_edges.h"
#include "core/pipeline/post_normals.h"
#include "core/pipeline/report.h"
#include "core/simplify/lod_chain.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The parts of a build that every step on a level uses. Requires: all outlive it.
struct LevelContext {
  const Terrain& terrain;
  const Horizon& horizon;
  const Georeference& georeference;
  const PostNormals& normals;
  MeshMeasurer& measurer;
  const RunControl& control;

  /// The same under another control, which must outlive it.
  [[nodiscard]] LevelContext With(const RunControl& other) const {
    return {terrain, horizon, georeference, normals, measurer, other};
  }
};

/// The control of level i of `count`.
inline RunControl LevelControl(const RunControl& control, std::size_t i, std::size_t count) {
  const auto share = [count](std::size_t n) {
    return static_cast<double>(n) / static_cast<double>(count);
  };
  return control.Between(share(i), share(i + 1));
}

/// How a level is to be stored.
///
/// finest_side_m, coarseness: as StepsOfLevel has them. glb, drc: which files are asked for. edges:
/// what the GLB is asked to say of the level's horizon. threads: never changes the result.
struct LevelStorage {
  double finest_side_m = 0;
  int coarseness = 0;
  bool glb = true;
  bool drc = true;
  EdgeFiles edges = EdgeFiles::kNone;
  int threads = 1;
};

/// A level as it is stored.
struct LevelArtifact {
  std::vector<std::uint8_t> drc;  ///< empty where it is not asked for
  std::vector<std::uint8_t> glb;  ///< likewise
  LocalMesh mesh;                 ///< what both decode to
  PlacedMesh placed;              ///< the same, to be measured
  QuantizationLattice lattice;    ///< of both
  LevelEdges edges;               ///< empty where they are not asked for
  LevelReport report;             ///< all but what is measured, and `asked`
};

/// Encodes one level and decodes it again.
/// Errors: those of Georeference::ToEnu, RoundToLattice, EncodeDraco, PlaceLevel and
///   FindLevelEdges.
Result<LevelArtifact> EncodeLevel(const LevelContext& context, const Lod& lod, int level,
                                  const LevelStorage& storage);

/// A decoded mesh as it is measured.
/// Errors: kUnsupportedData where a vertex names no post, or the mesh has a hole or a flipped
///   triangle; those of Georeference::ToGrid.
Result<PlacedMesh> PlaceLevel(const LevelContext& context, const LocalMesh& decoded);

/// Puts what was measured of a level into its report, rounded up.
void ReportErrors(const MeshError& error, LevelReport& report);

}  // namespace farhorizon
