#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/io/horizon_features.h"
#include "core/io/tileset.h"
#include "core/pipeline/build.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/report.h"
#include "core/terrain/dem.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// A DEM file, read, triangulated and placed on the globe: what every command starts from.
class TerrainInput {
 public:
  /// Errors: those of ReadDem, Terrain::Build and Georeference::Of, each saying which step it was.
  static Result<std::unique_ptr<TerrainInput>> Open(const std::filesystem::path& path,
                                                    const BuildOptions& options);

  [[nodiscard]] const Dem& dem() const { return dem_; }
  [[nodiscard]] const Terrain& terrain() const { return *terrain_; }
  [[nodiscard]] const Georeference& georeference() const { return *georeference_; }
  [[nodiscard]] const DemReport& report() const { return report_; }

  /// The longitudes, latitudes and heights of all posts of the terrain.
  [[nodiscard]] Result<BoundingRegion> Region() const;

  /// The horizon edges as they are published. level_kept: for each edge the coarsest level that has it,
  /// -1 for none; empty where no levels were built.
  [[nodiscard]] Result<std::vector<HorizonFeature>> Features(const Horizon& horizon,
                                                             const std::vector<int>& level_kept,
                                                             int threads, const Watch& watch) const;

 private:
  TerrainInput() = default;
  void Describe();

  Dem dem_;
  std::optional<Terrain> terrain_;
  std::optional<Georeference> georeference_;
  DemReport report_;
};

}  // namespace farhorizon
