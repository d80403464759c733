#include "core/pipeline/build.h"

#include <memory>

#include "service/cli/command.h"
#include "service/cli/dem_command.h"

namespace farhorizon {

namespace {

struct BuildArguments {
  DemArguments dem;
  std::string directory;
};

int Run(const BuildArguments& arguments) {
  return ExitStatusOf(RunOnDem(arguments.dem, Workflow::kBuild, [&](const DemRun& run) {
    return BuildArtifacts(arguments.dem.path, arguments.directory, run.options, run.control);
  }));
}

}  // namespace

void AddBuild(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<BuildArguments>();
  Command command = program.AddCommand("build", "Make the artifacts of a DEM in a folder");
  AddDem(command, arguments->dem);
  command.Add({.names = "-o,--output",
               .type = "DIR",
               .help = "folder for the artifacts; made if missing",
               .required = true},
              arguments->directory);
  AddBuildFlags(command, arguments->dem.flags);
  AddRunFlags(command, arguments->dem);
  AddTimings(command, arguments->dem, "write seconds by stage, as JSON, and into report.html, too");
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
