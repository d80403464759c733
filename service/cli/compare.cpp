#include "core/pipeline/compare/compare.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "core/io/file.h"
#include "core/pipeline/compare/comparison_json.h"
#include "core/pipeline/compare/comparison_text.h"
#include "service/cli/command.h"
#include "service/cli/dem_command.h"

namespace farhorizon {

namespace {

struct CompareArguments {
  DemArguments dem;
  std::string mesh;
  std::string file;
  std::string frame;
  std::string up;
  std::string tile;
  double height_offset_m = 0;
  bool json = false;
};

Result<CompareOptions> OptionsOf(const CompareArguments& arguments) {
  CompareOptions options;
  if (!arguments.frame.empty()) {
    options.placing.frame = MeshFrameFromName(arguments.frame);
    if (!options.placing.frame) {
      return Error{ErrorCode::kInvalidArgument,
                   "--mesh-frame is one of " + MeshFrameNames() + "; got " + arguments.frame,
                   "mesh-frame"};
    }
  }
  if (!arguments.up.empty()) {
    options.placing.up = arguments.up == "y" ? UpAxis::kY : UpAxis::kZ;
  }
  options.placing.height_offset_m = arguments.height_offset_m;
  if (!arguments.tile.empty()) options.tile = arguments.tile;
  options.picture = !arguments.file.empty();
  if (options.picture && !arguments.file.ends_with(".svg")) {
    return Error{ErrorCode::kInvalidArgument,
                 "\"" + arguments.file + "\" has an unknown ending; use .svg", "unknown-format"};
  }
  return options;
}

Status Print(const std::string& text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written) return Error{ErrorCode::kIo, "cannot write to the standard output", "io"};
  return Ok{};
}

int Run(const CompareArguments& arguments) {
  Result<Comparison> comparison =
      RunOnDem(arguments.dem, Workflow::kCompare, [&](const DemRun& run) -> Result<Comparison> {
        Result<CompareOptions> options = OptionsOf(arguments);
        if (!options) return std::move(options.error());
        return CompareMesh(arguments.dem.path, arguments.mesh, *options, run.options, run.control);
      });
  if (!comparison) return ReportError(comparison.error());
  if (!arguments.file.empty()) {
    Status written = WriteFile(arguments.file, comparison->picture);
    if (!written) return ReportError(written.error());
  }
  Status printed =
      Print(arguments.json ? ComparisonJson(*comparison) : ComparisonText(*comparison));
  if (!printed) return ReportError(printed.error());
  const bool sound = std::ranges::none_of(
      comparison->meshes, [](const MeshComparison& m) { return m.fault || m.IsUnsound(); });
  return sound ? kExitDone : kExitData;
}

}  // namespace

void AddCompare(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<CompareArguments>();
  Command command =
      program.AddCommand("compare", "Measure anyone's mesh against a DEM: heights, skyline, looks");
  AddDem(command, arguments->dem);
  command.Add({.names = "MESH",
               .type = "",
               .help = "GLB or glTF (also Draco, meshopt, quantised), b3dm, Draco .drc, OBJ, PLY, "
                       "STL; or a tileset.json, of which every content is measured",
               .required = true},
              arguments->mesh);
  command.AddSwitch("--json", "print JSON instead of a table", arguments->json);
  command.Add({.names = "-o,--output",
               .type = "FILE",
               .help = "draw the first mesh that is measured: skylines in four directions over the "
                       "DEM's with the difference enlarged, and a map of the vertical error; FILE "
                       "ends in .svg"},
              arguments->file);
  std::string frames = "what the mesh's coordinates are, where it is not found out";
  for (const MeshFrame frame : AllMeshFrames()) {
    frames += std::string("; ") + MeshFrameName(frame) + ": " + MeshFrameMeaning(frame);
  }
  command.Add({.names = "--mesh-frame", .type = "FRAME", .help = frames}, arguments->frame);
  command.AddChoice(
      {.names = "--mesh-up", .type = "AXIS", .help = "the axis of the mesh that is up: z or y"},
      arguments->up, {"y", "z"});
  command.Add({.names = "--mesh-height-offset",
               .type = "M",
               .help = "metres to add to the mesh's heights before they are compared"},
              arguments->height_offset_m, -20000, 20000);
  command.Add(
      {.names = "--tile", .type = "URI", .help = "of a tileset, only the content with this uri"},
      arguments->tile);
  AddTileFlags(command, arguments->dem.flags);
  AddReadFlags(command, arguments->dem.flags);
  AddWorkFlags(command, arguments->dem.flags);
  AddRunFlags(command, arguments->dem);
  command.SetFooter(
      "Exit status 1 where a mesh lies elsewhere, or is no sound surface: flipped triangles, "
      "triangles over one another, holes.");
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
