#include "core/pipeline/write_horizon.h"

#include <string>
#include <utility>

#include "core/io/file.h"
#include "core/io/horizon_features.h"
#include "core/io/horizon_vector.h"
#include "core/pipeline/build_features.h"
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
  watch.Report(Stage::kRead, 0);
  Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(dem, options);
  if (!input) return std::move(input.error());
  watch.Report(Stage::kRead, 1);
  HorizonOptions horizon_options = HorizonOptionsOf(options);
  horizon_options.engine = engine;
  Result<Horizon> horizon = FindHorizon((*input)->terrain(), horizon_options, watch);
  if (!horizon) return std::move(horizon.error());
  Result<std::vector<HorizonFeature>> features =
      BuildFeatures(**input, *horizon, {}, options.threads, watch);
  if (!features) return std::move(features.error());
  watch.Report(Stage::kWrite, 0);
  Status written = ending == ".geojson" ? WriteFile(out, WriteHorizonGeoJson(*features))
                                        : WriteHorizonVector(*features, out);
  watch.Report(Stage::kWrite, 1);
  return written;
}

}  // namespace farhorizon
