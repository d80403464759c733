#include <memory>
#include <optional>
#include <string>

#include "core/horizon/find_horizon.h"
#include "core/pipeline/sweep_picture.h"
#include "core/pipeline/write_horizon.h"
#include "service/cli/command.h"
#include "service/cli/reporter.h"
#include "service/cli/signals.h"
#include "service/cli/wishes.h"

namespace farhorizon {

namespace {

struct Call {
  std::string dem;
  std::string file;
  std::string engine = "auto";
  std::optional<double> trace_level_m;
  Wishes wishes;
  ReporterOptions reporter;
};

Engine EngineOf(const std::string& name) {
  // "auto" is the adaptive engine, which is the faster one on large terrain.
  return name == "kinetic" ? Engine::kKinetic : Engine::kAdaptive;
}

Workflow WorkflowOf(const Call& call) {
  if (call.trace_level_m) return Workflow::kTrace;
  return EngineOf(call.engine) == Engine::kKinetic ? Workflow::kKineticHorizon : Workflow::kHorizon;
}

int Run(const Call& call) {
  Result<BuildOptions> options = call.wishes.Options();
  if (!options) return Complain(options.error());
  const StopOnSignal signals;
  Reporter reporter(call.reporter);
  const Watch watch{reporter.progress(WorkflowOf(call)), signals.token(), reporter.notice()};
  Status written =
      call.trace_level_m
          ? WriteSweepPicture(call.dem, call.file, *call.trace_level_m, *options, watch)
          : WriteHorizonEdges(call.dem, call.file, *options, watch, EngineOf(call.engine));
  reporter.Clear();
  return written ? kExitDone : Complain(written.error());
}

}  // namespace

void AddHorizon(CLI::App& app, Chosen& chosen) {
  const auto call = std::make_shared<Call>();
  CLI::App* command = app.add_subcommand("horizon", "Write only the horizon edges of a DEM");
  command->add_option("DEM", call->dem, "GeoTIFF, ASCII grid, SRTM HGT, DTED, USGS DEM or ENVI")
      ->required()
      ->type_name("");
  command
      ->add_option("-o,--output", call->file,
                   "file to write; its ending tells the format: .geojson, .fgb, .gpkg; with "
                   "--trace-level .svg")
      ->required()
      ->type_name("FILE");
  command
      ->add_option(
          "--engine", call->engine,
          "algorithm that finds the edges: adaptive, kinetic, or auto, which is adaptive; all "
          "find the same ones")
      ->check(CLI::IsMember({"adaptive", "kinetic", "auto"}).description(""))
      ->type_name("ENGINE");
  command
      ->add_option("--trace-level", call->trace_level_m,
                   "instead of the edges, draw the sweep at the height of Z metres: contours, "
                   "hulls, bitangents, candidates")
      ->type_name("Z");
  AddReadWishes(*command, call->wishes);
  AddWorkWishes(*command, call->wishes);
  AddThreads(*command, call->wishes);
  AddReporterOptions(*command, call->reporter);
  command->callback([call, &chosen] { chosen = [call] { return Run(*call); }; });
}

}  // namespace farhorizon
