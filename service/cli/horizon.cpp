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
  std::string kinetic_hull = "turns";
  std::optional<double> trace_level_m;
};

Engine EngineOf(const HorizonArguments& arguments) {
  // "auto" is the adaptive engine, which is the faster one on large terrain.
  if (arguments.engine != "kinetic") return Engine::kAdaptive;
  return arguments.kinetic_hull == "bgh" ? Engine::kKineticTree : Engine::kKinetic;
}

Workflow WorkflowOf(const HorizonArguments& arguments) {
  if (arguments.trace_level_m) return Workflow::kTrace;
  return EngineOf(arguments) == Engine::kAdaptive ? Workflow::kHorizon : Workflow::kKineticHorizon;
}

int Run(const HorizonArguments& arguments) {
  const std::string& dem = arguments.dem.path;
  return ExitStatusOf(RunOnDem(arguments.dem, WorkflowOf(arguments), [&](const DemRun& run) {
    return arguments.trace_level_m
               ? WriteSweepPicture(dem, arguments.file, *arguments.trace_level_m, run.options,
                                   run.control)
               : WriteHorizonEdges(dem, arguments.file, run.options, run.control,
                                   EngineOf(arguments));
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
      ->add_option("--kinetic-hull", arguments->kinetic_hull,
                   "how --engine kinetic certifies hulls: turns, of neighbouring corners, or bgh, "
                   "the tree of Basch, Guibas and Hershberger; both find the same edges")
      ->check(CLI::IsMember({"turns", "bgh"}).description(""))
      ->type_name("HULL");
  command
      ->add_option("--trace-level", arguments->trace_level_m,
                   "instead of the edges, draw the sweep at the height of Z metres: contours, "
                   "hulls, bitangents, candidates")
      ->type_name("Z");
  AddReadFlags(*command, arguments->dem.flags);
  AddWorkFlags(*command, arguments->dem.flags);
  AddRunFlags(*command, arguments->dem);
  command->callback([arguments, &selected] { selected = [arguments] { return Run(*arguments); }; });
}

}  // namespace farhorizon
