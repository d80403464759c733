#include "core/pipeline/verify/verify.h"

#include <cstdio>
#include <memory>

#include "service/cli/command.h"
#include "service/cli/dem_command.h"

namespace farhorizon {

namespace {

struct VerifyArguments {
  DemArguments dem;
  std::string directory;
};

int Run(const VerifyArguments& arguments) {
  Result<std::vector<ClaimCheck>> checks =
      RunOnDem(arguments.dem, Workflow::kVerify, [&](const DemRun& run) {
        return VerifyArtifacts(
            arguments.dem.path, arguments.directory, run.options,
            RunControl{run.control.progress, run.control.stop, {}, run.control.on_assumption});
      });
  if (!checks) return ReportError(checks.error());
  std::size_t broken = 0;
  for (const ClaimCheck& check : *checks) {
    if (check.holds) continue;
    ++broken;
    std::printf("%s\n", check.claim.c_str());
  }
  std::fprintf(stderr, "farhorizon: %zu of %zu claims hold\n", checks->size() - broken,
               checks->size());
  return broken == 0 ? kExitDone : kExitData;
}

}  // namespace

void AddVerify(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<VerifyArguments>();
  Command command = program.AddCommand(
      "verify", "Measure every claim of DIR/report.json again, from the files alone");
  AddDem(command, arguments->dem, "the DEM that the artifacts were made of");
  command.Add({.names = "DIR", .type = "", .help = "the folder of the artifacts", .required = true},
              arguments->directory);
  AddReadFlags(command, arguments->dem.flags);
  AddRunFlags(command, arguments->dem);
  command.SetFooter("Exit status 1, and a line a claim on stdout, where one is false.");
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
