#include <memory>
#include <optional>
#include <string>

#include "core/horizon/find_horizon.h"
#include "core/pipeline/sweep_picture.h"
#include "core/pipeline/write_horizon.h"
#include "service/cli/command.h"
#include "service/cli/dem_command.h"

namespace farhorizon {

namespace {

struct HorizonArguments {
  DemArguments dem;
  std::string file;
  std::string engine = "auto";
  std::string weights = "full";
  std::optional<double> trace_level_m;
};

Engine EngineOf(const std::string& name) {
  // "auto" is the adaptive engine, which is the faster one on large terrain.
  return name == "kinetic" ? Engine::kKinetic : Engine::kAdaptive;
}

Weights WeightsOf(const std::string& name) {
  return name == "none" ? Weights::kNone : name == "fast" ? Weights::kFast : Weights::kFull;
}

Workflow WorkflowOf(const HorizonArguments& arguments) {
  if (arguments.trace_level_m) return Workflow::kTrace;
  return EngineOf(arguments.engine) == Engine::kKinetic ? Workflow::kKineticHorizon
                                                        : Workflow::kHorizon;
}

int Run(const HorizonArguments& arguments) {
  const std::string& dem = arguments.dem.path;
  return ExitStatusOf(RunOnDem(arguments.dem, WorkflowOf(arguments), [&](const DemRun& run) {
    return arguments.trace_level_m
               ? WriteSweepPicture(dem, arguments.file, *arguments.trace_level_m, run.options,
                                   run.control)
               : WriteHorizonEdges(dem, arguments.file,
                                   {.build = run.options,
                                    .engine = EngineOf(arguments.engine),
                                    .weights = WeightsOf(arguments.weights)},
                                   run.control);
  }));
}

}  // namespace

void AddHorizon(CLI::App& app, SelectedCommand& selected) {
  const auto arguments = std::make_shared<HorizonArguments>();
  CLI::App* command = app.add_subcommand("horizon", "Write only the horizon edges of a DEM");
  AddDem(*command, arguments->dem);
  command
      ->add_option("-o,--output", arguments->file,
                   "file to write; its ending tells the format: .geojson, .fgb, .gpkg; with "
                   "--trace-level .svg")
      ->required()
      ->type_name("FILE");
  command
      ->add_option(
          "--engine", arguments->engine,
          "algorithm that finds the edges: adaptive, kinetic, or auto, which is adaptive; all "
          "find the same ones")
      ->check(CLI::IsMember({"adaptive", "kinetic", "auto"}).description(""))
      ->type_name("ENGINE");
  command
      ->add_option(
          "--weights", arguments->weights,
          "what is said of each edge beside its witness: none; fast, all that follows from "
          "its lines of sight; full, its skyline drop, too (full)")
      ->check(CLI::IsMember({"none", "fast", "full"}).description(""))
      ->type_name("W");
  command
      ->add_option("--trace-level", arguments->trace_level_m,
                   "instead of the edges, draw the sweep at the height of Z metres: contours, "
                   "hulls, bitangents, candidates")
      ->type_name("Z");
  AddReadFlags(*command, arguments->dem.flags);
  AddWorkFlags(*command, arguments->dem.flags);
  AddRunFlags(*command, arguments->dem);
  AddTimings(*command, arguments->dem, "write seconds by stage, as JSON");
  command->callback([arguments, &selected] { selected = [arguments] { return Run(*arguments); }; });
}

}  // namespace farhorizon
