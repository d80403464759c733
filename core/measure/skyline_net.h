#pragma once

#include <cstdint>
#include <vector>

#include "core/horizon/horizon.h"
#include "core/measure/mesh_sides.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Segments of a surface of which, over every plan line, some one is as high as the surface.
///
/// segments: by points. outline: the surface ends there.
struct SkylineNet {
  struct Segment {
    std::int32_t a = 0;
    std::int32_t b = 0;
    bool outline = false;
  };
  std::vector<GridPoint> points;
  std::vector<Segment> segments;

  [[nodiscard]] const GridPoint& Point(std::int32_t i) const {
    return points[static_cast<std::size_t>(i)];
  }
};

/// The horizon edges, in their order (core/horizon/README.md, theorem 2).
SkylineNet SkylineNetOf(const Terrain& terrain, const Horizon& horizon);

/// The ridges and the outline of a mesh (lemma 0 there), without those that other ground of the
/// mesh occludes because they are in a merged hull of the DEM's, well below the horizon edges that
/// are there. points: those of the mesh.
/// sunk_m: how far the horizon edges off the outline are above the mesh at most.
SkylineNet SkylineNetOf(const Dem& dem, const HullMergeTree& hulls, const GridMesh& mesh,
                        const MeshSides& sides, double sunk_m);

}  // namespace farhorizon
