#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/io/tileset.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/report.h"
#include "core/terrain/dem.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// A DEM file, read, triangulated and georeferenced: what every command starts from.
class TerrainInput {
 public:
  /// Takes max_posts, crs, nodata and vertical_datum from `options`.
  /// Errors: those of ReadDem, Terrain::Build and Georeference::Of, each with the step's name.
  static Result<std::unique_ptr<TerrainInput>> Open(const std::filesystem::path& path,
                                                    const BuildOptions& options);

  [[nodiscard]] const Dem& dem() const { return dem_; }
  [[nodiscard]] const Terrain& terrain() const { return *terrain_; }
  [[nodiscard]] const Georeference& georeference() const { return *georeference_; }
  [[nodiscard]] const DemReport& report() const { return report_; }

  /// The least region with all posts that have data. Errors: those of Georeference::ToGeodetic.
  [[nodiscard]] Result<BoundingRegion> Region() const;

 private:
  TerrainInput() = default;
  void Describe();

  Dem dem_;
  std::optional<Terrain> terrain_;
  std::optional<Georeference> georeference_;
  DemReport report_;
};

}  // namespace farhorizon
