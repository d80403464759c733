#include "core/pipeline/verify/verify.h"

#include <cstdio>
#include <memory>

#include "service/cli/command.h"
#include "service/cli/reporter.h"
#include "service/cli/signals.h"
#include "service/cli/wishes.h"

namespace farhorizon {

namespace {

struct Call {
  std::string dem;
  std::string directory;
  Wishes wishes;
  ReporterOptions reporter;
};

int Run(const Call& call) {
  Result<BuildOptions> options = call.wishes.Options();
  if (!options) return Complain(options.error());
  const StopOnSignal signals;
  Reporter reporter(call.reporter);
  Result<std::vector<ClaimCheck>> checks =
      VerifyArtifacts(call.dem, call.directory, *options,
                      Watch{reporter.progress(Workflow::kVerify), signals.token()});
  reporter.Clear();
  if (!checks) return Complain(checks.error());
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

void AddVerify(CLI::App& app, Chosen& chosen) {
  const auto call = std::make_shared<Call>();
  CLI::App* command = app.add_subcommand(
      "verify", "Measure every claim of DIR/report.json again, from the files alone");
  command->add_option("DEM", call->dem, "the DEM that the artifacts were made of")
      ->required()
      ->type_name("");
  command->add_option("DIR", call->directory, "the folder of the artifacts")
      ->required()
      ->type_name("");
  AddReadWishes(*command, call->wishes);
  AddThreads(*command, call->wishes);
  AddReporterOptions(*command, call->reporter);
  command->footer("Exit status 1, and a line a claim on stdout, where one is false.");
  command->callback([call, &chosen] { chosen = [call] { return Run(*call); }; });
}

}  // namespace farhorizon
