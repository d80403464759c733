#include <cstdio>
#include <memory>
#include <string>

#include "core/io/file.h"
#include "core/pipeline/write_skyline.h"
#include "service/cli/command.h"
#include "service/cli/dem_command.h"

namespace farhorizon {

namespace {

struct SkylineArguments {
  DemArguments dem;
  std::string file;
  double azimuth_deg = 0;
};

Status Print(const std::string& text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written) return Error{ErrorCode::kIo, "cannot write to the standard output", "io"};
  return Ok{};
}

int Run(const SkylineArguments& arguments) {
  const std::string& file = arguments.file;
  Result<std::string> skyline =
      RunOnDem(arguments.dem, Workflow::kSkyline, [&](const DemRun& run) -> Result<std::string> {
        Result<SkylineFormat> format =
            file.empty() ? SkylineFormat::kGeoJson : SkylineFormatOf(file);
        if (!format) return std::move(format.error());
        return WriteSkyline(arguments.dem.path, arguments.azimuth_deg, *format, run.options,
                            run.control);
      });
  if (!skyline) return ReportError(skyline.error());
  return ExitStatusOf(file.empty() ? Print(*skyline) : WriteFile(file, *skyline));
}

}  // namespace

void AddSkyline(CLI::App& app, SelectedCommand& selected) {
  const auto arguments = std::make_shared<SkylineArguments>();
  CLI::App* command = app.add_subcommand(
      "skyline", "Write the horizon edges seen in one direction, from left to right");
  AddDem(*command, arguments->dem);
  command
      ->add_option("--azimuth", arguments->azimuth_deg,
                   "where to look, degrees clockwise from true north at the DEM's middle, -360 to "
                   "360")
      ->required()
      ->type_name("A");
  command
      ->add_option("-o,--output", arguments->file,
                   "file to write; its ending tells the format: .geojson or .svg, a picture; "
                   "without it GeoJSON on the standard output")
      ->type_name("FILE");
  AddReadFlags(*command, arguments->dem.flags);
  AddWorkFlags(*command, arguments->dem.flags);
  AddRunFlags(*command, arguments->dem);
  command->callback([arguments, &selected] { selected = [arguments] { return Run(*arguments); }; });
}

}  // namespace farhorizon
