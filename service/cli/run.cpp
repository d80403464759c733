#include "service/cli/run.h"

#include <cstdio>
#include <exception>
#include <new>

#include "core/pipeline/version.h"
#include "service/cli/command.h"

namespace farhorizon {

int Complain(const Error& error) {
  std::fprintf(stderr, "farhorizon: %s\n", error.message.c_str());
  switch (error.code) {
    case ErrorCode::kInvalidArgument:
      return kExitCall;
    case ErrorCode::kCancelled:
      return kExitInterrupted;
    case ErrorCode::kNotFound:
    case ErrorCode::kUnsupportedData:
    case ErrorCode::kResourceExhausted:
    case ErrorCode::kIo:
      return kExitData;
  }
  return kExitBug;
}

int RunProgram(int argc, char** argv) {
  CLI::App app(
      "farhorizon turns elevation grids into levels of detail whose skyline is exactly that of the "
      "original.",
      "farhorizon");
  app.set_version_flag("--version", std::string("farhorizon ") + Version());
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 done, 1 the data or a claim is at fault, 2 the call is, 70 our own bug,\n"
      "130 interrupted. 'farhorizon COMMAND --help' tells more.");
  Chosen chosen;
  AddBuild(app, chosen);
  AddHorizon(app, chosen);
  AddSkyline(app, chosen);
  AddVerify(app, chosen);
  AddServe(app, chosen);
  AddSubmit(app, chosen);
  AddHealthcheck(app, chosen);
  AddWorker(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& failure) {
    return app.exit(failure) == 0 ? kExitDone : kExitCall;
  }
  try {
    return chosen();
  } catch (const std::bad_alloc&) {
    return Complain({ErrorCode::kResourceExhausted,
                     "out of memory; give a smaller DEM or a larger machine", "memory-limit"});
  } catch (const std::exception& bug) {
    std::fprintf(stderr, "farhorizon: internal error, please report it: %s\n", bug.what());
    return kExitBug;
  }
}

}  // namespace farhorizon
