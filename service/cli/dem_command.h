#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/pipeline/build.h"
#include "core/pipeline/progress_plan.h"
#include "service/cli/build_flags.h"
#include "service/cli/command_line.h"
#include "service/cli/reporter.h"
#include "service/cli/signals.h"

namespace farhorizon {

/// The formats of the positional argument DEM, for help.
constexpr const char* kDemFormats =
    "GeoTIFF, text grid (Arc/Info, GRASS, Surfer, x y z), SRTM HGT, also zipped, DTED, USGS DEM, "
    "Erdas Imagine, Surfer, ENVI or Esri .flt and .bil";

/// The arguments that every command on a DEM has.
struct DemArguments {
  std::string path;
  BuildFlags flags;
  ReporterOptions reporter;
};

/// Adds the positional argument DEM. Requires: `arguments` outlives the parse.
void AddDem(Command& command, DemArguments& arguments, const char* help = kDemFormats);
/// Adds --threads and --progress. Requires: as above.
void AddRunFlags(Command& command, DemArguments& arguments);

/// A command while it works: its options, progress, and a stop token for SIGINT and SIGTERM.
struct DemRun {
  const BuildOptions& options;
  Reporter& reporter;
  RunControl control;
};

/// Calls work(const DemRun&) and returns its Result, after the progress bar was removed.
/// workflow: the stages that `work` goes through.
/// Errors: those of BuildFlags::Options and of `work`.
template <typename Work>
auto RunOnDem(const DemArguments& arguments, Workflow workflow, Work work)
    -> std::invoke_result_t<Work, const DemRun&> {
  Result<BuildOptions> options = arguments.flags.Options();
  if (!options) return std::move(options.error());
  const StopOnSignal signals;
  Reporter reporter(arguments.reporter);
  const RunControl control{reporter.progress(workflow), signals.token(), reporter.warn(),
                           reporter.assume()};
  return work(DemRun{*options, reporter, control});
}

}  // namespace farhorizon
