#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/report.h"
#include "core/terrain/dem.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// A DEM file, read, triangulated and georeferenced: what every command starts from. Rows and
/// columns of an apron are no part of it; they are in `around` alone.
class TerrainInput {
 public:
  static constexpr std::int64_t kAll = std::numeric_limits<std::int64_t>::max();

  /// Takes from `options` what says how to read and to place a DEM, and tells `control` of each
  /// assumption. most_decoded: as DemReadOptions has it; where the heights stay unread, a flat
  /// terrain of few posts at the DEM's place stands in for it (HeaderOnly).
  /// Errors: those of ReadDem, Terrain::Build, Georeference::Of and CheckPlacement, each with the
  ///   step's name.
  static Result<std::unique_ptr<TerrainInput>> Open(const std::filesystem::path& path,
                                                    const BuildOptions& options,
                                                    const RunControl& control,
                                                    std::int64_t most_decoded = kAll);

  [[nodiscard]] bool HeaderOnly() const { return header_only_; }
  /// Of the file, whether its heights were read or not.
  [[nodiscard]] std::int64_t posts() const { return posts_; }
  [[nodiscard]] const Dem& dem() const { return dem_; }
  [[nodiscard]] const Terrain& terrain() const { return *terrain_; }
  /// The terrain with its apron, and how wide that is; the terrain itself and 0 where it has none.
  [[nodiscard]] const Terrain& around() const { return around_ ? *around_ : *terrain_; }
  [[nodiscard]] int apron() const { return report_.apron; }
  [[nodiscard]] const Georeference& georeference() const { return *georeference_; }
  [[nodiscard]] const DemReport& report() const { return report_; }
  /// What was assumed about the heights and their place, in the order in which it was met.
  [[nodiscard]] const Assumptions& assumptions() const { return assumptions_; }

 private:
  TerrainInput() = default;
  void Describe();
  Status CutApron(int apron);
  void Assume(const Assumptions& assumptions, const RunControl& control);

  Dem dem_;
  Dem dem_around_;  // with the apron; empty where there is none
  std::int64_t posts_ = 0;
  bool header_only_ = false;
  std::optional<Terrain> terrain_;
  std::optional<Terrain> around_;
  std::optional<Georeference> georeference_;
  DemReport report_;
  Assumptions assumptions_;
};

}  // namespace farhorizon
