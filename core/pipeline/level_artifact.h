#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/io/draco_mesh.h"
#include "core/io/local_mesh.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/level_parts.h"
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
/// finest_side_m, coarseness: as StepsOfLevel has them. skirt_room_m: how deep its skirt may be.
/// glb, drc: which files are asked for.
struct LevelStorage {
  double finest_side_m = 0;
  int coarseness = 0;
  double skirt_room_m = 0;
  bool glb = true;
  bool drc = true;
};

/// The surface of a part of a level, as Draco has it, and how many triangles it is.
struct EncodedPart {
  PartPlace place;
  std::vector<std::uint8_t> draco;
  std::size_t triangles = 0;
};

/// A level as it is stored.
struct LevelArtifact {
  std::vector<std::uint8_t> drc;   ///< empty where it is not asked for
  std::vector<EncodedPart> parts;  ///< likewise: the surface of each GLB
  /// What both decode to, with posts; the triangles of the parts in turn (JoinMeshes), where the
  /// level is cut.
  DecodedMesh decoded;
  /// The edges that the GLB is to flag, by vertices of `decoded`; EncodeLevel leaves it empty.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> flagged;
  LevelReport report;  ///< all but what is measured or of the GLB, and `asked`
};

/// Encodes one level and decodes it again.
/// Errors: those of Georeference::ToEnu, RoundToLattice and EncodeDraco.
Result<LevelArtifact> EncodeLevel(const LevelContext& context, const Lod& lod, int level,
                                  const LevelStorage& storage);

/// The GLB of a part of a level, and what its surface and its skirt decode to.
struct PartGlb {
  std::string name;
  std::vector<std::uint8_t> bytes;
  LocalMesh surface;
  LocalMesh skirt;
};

/// The GLBs of a level, each with a skirt along its own rim that is skirt_m deep; 0: none.
/// level.report gets what they are.
/// Requires: the level was encoded with GLBs, and room for the skirt.
/// Errors: those of EncodeDraco.
Result<std::vector<PartGlb>> LevelGlbs(const LevelContext& context, double skirt_m,
                                       LevelArtifact& level);

/// A decoded mesh as it is measured.
/// Errors: kUnsupportedData where a vertex names no post, or the mesh has a hole or a flipped
///   triangle; those of Georeference::ToGrid.
Result<PlacedMesh> PlaceLevel(const LevelContext& context, const LocalMesh& decoded);

/// Puts what was measured of a level into its report, rounded up.
void ReportErrors(const MeshError& error, LevelReport& report);

}  // namespace farhorizon
