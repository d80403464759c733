#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/io/draco_mesh.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/post_normals.h"
#include "core/pipeline/report.h"
#include "core/simplify/lod_chain.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What every step on a level needs to know of its DEM.
struct LevelContext {
  const Terrain& terrain;
  const Horizon& horizon;
  const Georeference& georeference;
  const PostNormals& normals;
  const Watch& watch;

  /// The same, watched by another watch, which must outlive it.
  [[nodiscard]] LevelContext With(const Watch& other) const {
    return {terrain, horizon, placement, normals, other};
  }
};

/// The watch for level i of `count`.
inline Watch LevelWatch(const Watch& watch, std::size_t i, std::size_t count) {
  const auto share = [count](std::size_t n) {
    return static_cast<double>(n) / static_cast<double>(count);
  };
  return watch.Between(share(i), share(i + 1));
}

/// A level as it is stored, and what was measured on what it decodes to.
struct LevelArtifact {
  std::vector<std::uint8_t> drc;
  std::vector<std::uint8_t> glb;
  LevelReport report;  ///< horizon_edges and the bytes are set too
};

/// The lattice for the positions of all of the terrain's posts with a step of at most `wanted_step_m`,
/// where 16 bits allow it.
Result<QuantizationLattice> LatticeFor(const Terrain& terrain, const Georeference& georeference,
                                       double wanted_step_m);

/// Encodes one level and measures it on the decoded mesh. `asked_m`: its silhouette budget.
/// Errors: those of placing and encoding; kCancelled.
Result<LevelArtifact> EncodeLevel(const LevelContext& context, const Lod& lod, int level,
                                  const QuantizationLattice& lattice, double asked_m);

/// Both errors and the counts of a decoded mesh; bytes and horizon_edges are left to the caller.
/// Errors: kUnsupportedData where the mesh is no image of posts, has a hole or a flipped triangle.
Result<LevelReport> MeasureLevel(const LevelContext& context, const LocalMesh& decoded, int level,
                                 double step_m, double asked_m);

}  // namespace farhorizon
