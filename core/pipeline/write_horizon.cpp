#include "core/pipeline/write_horizon.h"

#include <utility>

#include "core/horizon/find_horizon.h"
#include "core/io/file.h"
#include "core/io/horizon_features.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

Status WriteHorizonEdges(const std::filesystem::path& dem, const std::filesystem::path& out,
                         const BuildOptions& options, const Watch& watch, Engine engine) {
  const std::string ending = out.extension().string();
  if (ending != ".geojson" && ending != ".fgb" && ending != ".gpkg") {
    return Error{ErrorCode::kInvalidArgument,
                 "no format has the ending \"" + ending + "\"; use .geojson, .fgb or .gpkg",
                 "unknown-format"};
  }
  watch.Report("read", 0);
  Result<std::unique_ptr<TerrainInput>> source = TerrainInput::Open(dem, options);
  if (!source) return std::move(source.error());
  Result<Horizon> horizon = FindHorizon((*source)->terrain(),
                                        {.threads = options.threads,
                                         .engine = engine,
                                         .work_budget = options.work_budget,
                                         .approximate = options.approximate},
                                        watch);
  if (!horizon) return std::move(horizon.error());
  Result<std::vector<HorizonFeature>> features =
      (*source)->Features(*horizon, {}, options.threads, watch);
  if (!features) return std::move(features.error());
  if (ending == ".geojson") return WriteFile(out, WriteHorizonGeoJson(*features));
  return WriteHorizonVector(*features, out);
}

}  // namespace farhorizon
