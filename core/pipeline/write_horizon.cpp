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
                         const HorizonFileOptions& options, const RunControl& control) {
  const std::string ending = out.extension().string();
  if (ending != ".geojson" && ending != ".fgb" && ending != ".gpkg") {
    return Error{ErrorCode::kInvalidArgument,
                 "no format has the ending \"" + ending + "\"; use .geojson, .fgb or .gpkg",
                 "unknown-format"};
  }
  control.Report(Stage::kRead, 0);
  Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(dem, options.build, control);
  if (!input) return std::move(input.error());
  control.Report(Stage::kRead, 1);
  HorizonOptions horizon_options = HorizonOptionsOf(options.build);
  horizon_options.engine = options.engine;
  if (options.weights == Weights::kNone) horizon_options.budget_share = 1;
  WorkBudget budget = WorkBudgetOf((*input)->terrain(), horizon_options);
  Result<Horizon> horizon = FindHorizon((*input)->terrain(), horizon_options, budget, control);
  if (!horizon) return std::move(horizon.error());
  const MeasureOptions measuring{
      .budget = budget, .threads = options.build.threads, .weights = options.weights};
  Result<std::vector<HorizonFeature>> features =
      BuildFeatures(**input, *horizon, {}, measuring, control);
  if (!features) return std::move(features.error());
  control.Report(Stage::kWrite, 0);
  Status written = ending == ".geojson" ? WriteFile(out, WriteHorizonGeoJson(*features))
                                        : WriteHorizonVector(*features, out);
  control.Report(Stage::kWrite, 1);
  return written;
}

}  // namespace farhorizon
