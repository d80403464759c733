#include "service/cli/run.h"

#include <cstdio>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>

#include "core/pipeline/version.h"
#include "service/cli/command.h"
#include "service/cli/environment.h"
#include "service/cli/job_commands.h"

namespace farhorizon {

int RunProgram(int argc, char** argv) {
  KeepOnlyKnownEnvironment();
  CLI::App app(
      "farhorizon turns elevation grids into levels of detail whose skyline is exactly that of the "
      "original.",
      "farhorizon");
  app.set_version_flag("--version", std::string("farhorizon ") + Version());
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 done, 1 the data or a claim is at fault, 2 the call is, 70 our own bug,\n"
      "74 the disk under a service failed, 75 a service is busy or out of reach, or a job has not\n"
      "ended: try again, 130 interrupted.\n"
      "'farhorizon COMMAND --help' tells more.");
  Command program(app);
  SelectedCommand selected;
  AddBuild(program, selected);
  AddHorizon(program, selected);
  AddSkyline(program, selected);
  AddCompare(program, selected);
  AddVerify(program, selected);
  AddViewer(program, selected);
  AddServe(program, selected);
  AddWork(program, selected);
  AddBackup(program, selected);
  AddFsck(program, selected);
  AddKeys(program, selected);
  AddSubmit(program, selected);
  AddJobCommands(program, selected);
  AddHealthcheck(program, selected);
  AddWorker(program, selected);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& failure) {
    return app.exit(failure) == 0 ? kExitDone : kExitCall;
  }
  try {
    return selected();
  } catch (const std::bad_alloc&) {
    return ReportError({ErrorCode::kResourceExhausted,
                        "out of memory; give a smaller DEM or a larger machine", "memory-limit"});
  } catch (const std::exception& bug) {
    std::fprintf(stderr, "farhorizon: internal error, please report it: %s\n", bug.what());
    return kExitBug;
  }
}

}  // namespace farhorizon
