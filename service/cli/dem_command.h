#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/geo/reference_data.h"
#include "core/pipeline/build.h"
#include "core/pipeline/progress_plan.h"
#include "service/cli/build_flags.h"
#include "service/cli/command_line.h"
#include "service/cli/reporter.h"
#include "service/cli/signals.h"
#include "service/stage_timer.h"

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
  std::string timings;  ///< file for the seconds by stage; empty: none
};

/// Adds the positional argument DEM. Requires: `arguments` outlives the parse.
void AddDem(Command& command, DemArguments& arguments, const char* help = kDemFormats);
/// Adds --threads and --progress. Requires: as above.
void AddRunFlags(Command& command, DemArguments& arguments);
/// Adds --timings. Requires: as above.
void AddTimings(Command& command, DemArguments& arguments, const char* help);

/// Writes seconds by stage as JSON. Errors: kIo.
Status WriteTimings(const std::string& path, const StageSeconds& seconds);

/// A command while it works: its options, progress, and a stop token for SIGINT and SIGTERM.
struct DemRun {
  const BuildOptions& options;
  Reporter& reporter;
  RunControl control;
};

/// Calls work(const DemRun&) and returns its Result, after the progress bar was removed and the
/// timings were written. workflow: the stages that `work` goes through.
/// Errors: those of CheckReferenceData, BuildFlags::Options, of `work` and of WriteTimings.
template <typename Work>
auto RunOnDem(const DemArguments& arguments, Workflow workflow, Work work)
    -> std::invoke_result_t<Work, const DemRun&> {
  if (Status there = CheckReferenceData(); !there) return std::move(there.error());
  Result<BuildOptions> options = arguments.flags.Options();
  if (!options) return std::move(options.error());
  const StopOnSignal signals;
  Reporter reporter(arguments.reporter);
  StageTimer timer;
  const bool timed = !arguments.timings.empty();
  RunControl control{timer.Listen(reporter.progress(workflow)), signals.token(), reporter.warn(),
                     reporter.assume()};
  if (timed) control.timings = [&timer] { return timer.Seconds(); };
  auto result = work(DemRun{*options, reporter, control});
  if (!result || !timed) return result;
  Status written = WriteTimings(arguments.timings, timer.Seconds());
  if (!written) return std::move(written.error());
  return result;
}

}  // namespace farhorizon
