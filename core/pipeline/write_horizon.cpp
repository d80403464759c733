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
                         const BuildOptions& options, const RunControl& control, Engine engine) {
  const std::string ending = out.extension().string();
  if (ending != ".geojson" && ending != ".fgb" && ending != ".gpkg") {
    return Error{ErrorCode::kInvalidArgument,
                 "no format has the ending \"" + ending + "\"; use .geojson, .fgb or .gpkg",
                 "unknown-format"};
  }
  control.Report(Stage::kRead, 0);
  Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(dem, options, control);
  if (!input) return std::move(input.error());
  control.Report(Stage::kRead, 1);
  HorizonOptions horizon_options = HorizonOptionsOf(options);
  horizon_options.engine = engine;
  Result<Horizon> horizon = FindHorizon((*input)->terrain(), horizon_options, control);
  if (!horizon) return std::move(horizon.error());
  Result<std::vector<HorizonFeature>> features =
      BuildFeatures(**input, *horizon, {}, options.threads, control);
  if (!features) return std::move(features.error());
  control.Report(Stage::kWrite, 0);
  Status written = ending == ".geojson" ? WriteFile(out, WriteHorizonGeoJson(*features))
                                        : WriteHorizonVector(*features, out);
  control.Report(Stage::kWrite, 1);
  return written;
}

}  // namespace farhorizon
