#include <cstdio>
#include <memory>
#include <string>

#include "core/io/file.h"
#include "core/pipeline/write_skyline.h"
#include "service/cli/command.h"
#include "service/cli/reporter.h"
#include "service/cli/signals.h"
#include "service/cli/wishes.h"

namespace farhorizon {

namespace {

struct Call {
  std::string dem;
  std::string file;
  double azimuth = 0;
  Wishes wishes;
  ReporterOptions reporter;
};

Status Print(const std::string& text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written) return Error{ErrorCode::kIo, "cannot write to the standard output", "io"};
  return Done{};
}

int Run(const Call& call) {
  Result<BuildOptions> options = call.wishes.Options();
  if (!options) return Complain(options.error());
  Result<SkylineFormat> format =
      call.file.empty() ? SkylineFormat::kGeoJson : SkylineFormatOf(call.file);
  if (!format) return Complain(format.error());
  const StopOnSignal signals;
  Reporter reporter(call.reporter);
  Result<std::string> skyline =
      WriteSkyline(call.dem, call.azimuth, *format, *options,
                   Watch{reporter.progress(), signals.token(), reporter.notice()});
  reporter.Clear();
  if (!skyline) return Complain(skyline.error());
  Status written = call.file.empty() ? Print(*skyline) : WriteFile(call.file, *skyline);
  return written ? kExitDone : Complain(written.error());
}

}  // namespace

void AddSkyline(CLI::App& app, Chosen& chosen) {
  const auto call = std::make_shared<Call>();
  CLI::App* command = app.add_subcommand(
      "skyline", "Write the horizon edges seen in one direction, from left to right");
  command->add_option("DEM", call->dem, "GeoTIFF, ASCII grid, SRTM HGT, DTED, USGS DEM or ENVI")
      ->required()
      ->type_name("");
  command
      ->add_option("--azimuth", call->azimuth,
                   "where to look, degrees clockwise from true north at the DEM's middle, -360 to "
                   "360")
      ->required()
      ->type_name("A");
  command
      ->add_option("-o,--output", call->file,
                   "file to write; its ending tells the format: .geojson or .svg, a picture; "
                   "without it GeoJSON on the standard output")
      ->type_name("FILE");
  AddReadWishes(*command, call->wishes);
  AddWorkWishes(*command, call->wishes);
  AddThreads(*command, call->wishes);
  AddReporterOptions(*command, call->reporter);
  command->callback([call, &chosen] { chosen = [call] { return Run(*call); }; });
}

}  // namespace farhorizon
