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
  std::string kinetic_hull = "turns";
  std::optional<double> trace_level_m;
};

Engine EngineOf(const HorizonArguments& arguments) {
  // "auto" is the adaptive engine, which is the faster one on large terrain.
  if (arguments.engine != "kinetic") return Engine::kAdaptive;
  return arguments.kinetic_hull == "bgh" ? Engine::kKineticTree : Engine::kKinetic;
}

Weights WeightsOf(const std::string& name) {
  return name == "none" ? Weights::kNone : name == "fast" ? Weights::kFast : Weights::kFull;
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
               : WriteHorizonEdges(dem, arguments.file,
                                   {.build = run.options,
                                    .engine = EngineOf(arguments),
                                    .weights = WeightsOf(arguments.weights)},
                                   run.control);
  }));
}

}  // namespace

void AddHorizon(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<HorizonArguments>();
  Command command = program.AddCommand("horizon", "Write only the horizon edges of a DEM");
  AddDem(command, arguments->dem);
  command.Add({.names = "-o,--output",
               .type = "FILE",
               .help = "file to write; its ending tells the format: .geojson, .fgb, .gpkg; with "
                       "--trace-level .svg",
               .required = true},
              arguments->file);
  command.AddChoice({.names = "--engine",
                     .type = "ENGINE",
                     .help = "algorithm that finds the edges: adaptive, kinetic, or auto, which is "
                             "adaptive; all find the same ones"},
                    arguments->engine, {"adaptive", "kinetic", "auto"});
  command.AddChoice(
      {.names = "--kinetic-hull",
       .type = "HULL",
       .help = "how --engine kinetic certifies hulls: turns, of neighbouring corners, "
               "or bgh, the tree of Basch, Guibas and Hershberger; both find the same "
               "edges"},
      arguments->kinetic_hull, {"turns", "bgh"});
  command.AddChoice({.names = "--weights",
                     .type = "W",
                     .help = "what is said of each edge beside its witness: none; fast, all that "
                             "follows from its lines of sight; full, its skyline drop, too (full)"},
                    arguments->weights, {"none", "fast", "full"});
  command.Add({.names = "--trace-level",
               .type = "Z",
               .help = "instead of the edges, draw the sweep at the height of Z metres: contours, "
                       "hulls, bitangents, candidates"},
              arguments->trace_level_m);
  AddReadFlags(command, arguments->dem.flags);
  AddWorkFlags(command, arguments->dem.flags);
  AddRunFlags(command, arguments->dem);
  AddTimings(command, arguments->dem, "write seconds by stage, as JSON");
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
