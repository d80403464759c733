#include "core/pipeline/build.h"

#include <fstream>
#include <memory>

#include <nlohmann/json.hpp>

#include "service/cli/command.h"
#include "service/cli/dem_command.h"
#include "service/stage_timer.h"

namespace farhorizon {

namespace {

struct BuildArguments {
  DemArguments dem;
  std::string directory;
  std::string timings;
};

Status WriteTimings(const std::string& path, StageTimer& timer) {
  std::ofstream file(path);
  file << nlohmann::json(timer.Seconds()).dump(2) << "\n";
  file.close();
  if (file) return Ok{};
  return Error{ErrorCode::kIo, "cannot write the timings to " + path};
}

int Run(const BuildArguments& arguments) {
  return ExitStatusOf(RunOnDem(arguments.dem, Workflow::kBuild, [&](const DemRun& run) {
    StageTimer timer;
    RunControl control = run.control;
    control.progress = timer.Listen(run.control.progress);
    if (!arguments.timings.empty()) control.timings = [&timer] { return timer.Seconds(); };
    Status built = BuildArtifacts(arguments.dem.path, arguments.directory, run.options, control);
    if (built && !arguments.timings.empty()) built = WriteTimings(arguments.timings, timer);
    return built;
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
  command.Add({.names = "--timings",
               .type = "FILE",
               .help = "write seconds by stage, as JSON, and into report.html, too"},
              arguments->timings);
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
