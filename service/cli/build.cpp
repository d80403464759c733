#include "core/pipeline/build.h"

#include <fstream>
#include <memory>

#include <nlohmann/json.hpp>

#include "service/cli/command.h"
#include "service/cli/reporter.h"
#include "service/cli/signals.h"
#include "service/cli/wishes.h"
#include "service/stage_timer.h"

namespace farhorizon {

namespace {

struct Call {
  std::string dem;
  std::string directory;
  std::string timings;
  Wishes wishes;
  ReporterOptions reporter;
};

Status WriteTimings(const std::string& path, StageTimer& timer) {
  std::ofstream file(path);
  file << nlohmann::json(timer.Seconds()).dump(2) << "\n";
  file.close();
  if (file) return Done{};
  return Error{ErrorCode::kIo, "cannot write the timings to " + path};
}

int Run(const Call& call) {
  Result<BuildOptions> options = call.wishes.Options();
  if (!options) return Complain(options.error());
  const StopOnSignal signals;
  Reporter reporter(call.reporter);
  StageTimer timer;
  const Watch watch{timer.Listen(reporter.progress(Workflow::kBuild)), signals.token(),
                    reporter.notice()};
  Status built = BuildArtifacts(call.dem, call.directory, *options, watch);
  if (built && !call.timings.empty()) built = WriteTimings(call.timings, timer);
  reporter.Clear();
  return built ? kExitDone : Complain(built.error());
}

}  // namespace

void AddBuild(CLI::App& app, Chosen& chosen) {
  const auto call = std::make_shared<Call>();
  CLI::App* command = app.add_subcommand("build", "Make the artifacts of a DEM in a folder");
  command->add_option("DEM", call->dem, "GeoTIFF, ASCII grid, SRTM HGT, DTED, USGS DEM or ENVI")
      ->required()
      ->type_name("");
  command->add_option("-o,--output", call->directory, "folder for the artifacts; made if missing")
      ->required()
      ->type_name("DIR");
  AddBuildWishes(*command, call->wishes);
  AddThreads(*command, call->wishes);
  AddReporterOptions(*command, call->reporter);
  command->add_option("--timings", call->timings, "write seconds by stage, as JSON")
      ->type_name("FILE");
  command->callback([call, &chosen] { chosen = [call] { return Run(*call); }; });
}

}  // namespace farhorizon
