#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/io/local_mesh.h"
#include "core/io/quantization_lattice.h"
#include "core/pipeline/georeference.h"
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
  const RunControl& control;

  /// The same under another control, which must outlive it.
  [[nodiscard]] LevelContext With(const RunControl& other) const {
    return {terrain, horizon, georeference, normals, other};
  }
};

/// The control of level i of `count`.
inline RunControl LevelControl(const RunControl& control, std::size_t i, std::size_t count) {
  const auto share = [count](std::size_t n) {
    return static_cast<double>(n) / static_cast<double>(count);
  };
  return control.Between(share(i), share(i + 1));
}

/// A level as it is stored, and the measures of the mesh that it decodes to.
struct LevelArtifact {
  std::vector<std::uint8_t> drc;
  std::vector<std::uint8_t> glb;
  LocalMesh mesh;      ///< what both decode to
  LevelReport report;  ///< all but `asked`
};

/// Encodes one level and measures it on the decoded mesh.
/// step_m: its lattice's, at most, where 16 bits reach over the level.
/// Errors: those of Georeference::ToEnu, EncodeDraco and MeasureLevel.
Result<LevelArtifact> EncodeLevel(const LevelContext& context, const Lod& lod, int level,
                                  double step_m);

/// The three errors and the counts of a decoded mesh; exact, horizon_edges, bytes and what was
/// asked are left to the caller.
/// Errors: kUnsupportedData where a vertex names no post, or the mesh has a hole or a flipped
///   triangle; kCancelled; those of Georeference::ToGrid.
Result<LevelReport> MeasureLevel(const LevelContext& context, const LocalMesh& decoded, int level,
                                 double step_m);

}  // namespace farhorizon
