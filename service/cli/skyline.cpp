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

void AddSkyline(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<SkylineArguments>();
  Command command = program.AddCommand(
      "skyline", "Write the horizon edges seen in one direction, from left to right");
  AddDem(command, arguments->dem);
  command.Add({.names = "--azimuth",
               .type = "A",
               .help = "where to look, degrees clockwise from true north at the DEM's middle, -360 "
                       "to 360",
               .required = true},
              arguments->azimuth_deg);
  command.Add({.names = "-o,--output",
               .type = "FILE",
               .help = "file to write; its ending tells the format: .geojson or .svg, a picture; "
                       "without it GeoJSON on the standard output"},
              arguments->file);
  AddReadFlags(command, arguments->dem.flags);
  AddWorkFlags(command, arguments->dem.flags);
  AddRunFlags(command, arguments->dem);
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
