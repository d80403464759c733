#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "core/io/file.h"
#include "service/cli/command.h"
#include "service/pages/asset_folder.h"
#include "service/pages/pages.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

struct ViewerArguments {
  std::string directory;
  std::string cesium;
};

Error CannotWrite(const fs::path& path, const std::error_code& failure) {
  return {ErrorCode::kIo, path.string() + ": " + failure.message(), "io"};
}

// The files of CesiumJS, but not their copies in gzip, which most servers make themselves.
Status CopyAssets(const AssetFolder& assets, const fs::path& target) {
  std::error_code failure;
  for (const auto& [name, asset] : assets.assets()) {
    if (name.ends_with(".gz")) continue;
    const fs::path to = target / name;
    fs::create_directories(to.parent_path(), failure);
    if (!failure) fs::copy_file(asset.path, to, fs::copy_options::overwrite_existing, failure);
    if (failure) return CannotWrite(to, failure);
  }
  return Ok{};
}

Status WriteViewer(const ViewerArguments& arguments) {
  const fs::path directory = arguments.directory;
  std::error_code failure;
  if (!fs::is_regular_file(directory / "tileset.json", failure)) {
    return Error{ErrorCode::kNotFound,
                 arguments.directory + " has no tileset.json; give a folder that build has made",
                 "no-such-file"};
  }
  const fs::path cesium = arguments.cesium.empty() ? InstalledCesium() : fs::path(arguments.cesium);
  if (cesium.empty()) {
    return Error{ErrorCode::kNotFound,
                 "CesiumJS is not installed; run service/pages/install-cesium, which needs npm, or "
                 "name a folder that it has made with --cesium",
                 "no-such-file"};
  }
  const Result<AssetFolder> assets = AssetFolder::Read(cesium);
  if (!assets) return assets.error();
  Status copied = CopyAssets(*assets, directory / "cesium");
  if (!copied) return copied;
  return WriteFile(directory / "viewer.html", StandaloneViewer({"", "cesium", ""}));
}

int Run(const ViewerArguments& arguments) {
  const Status written = WriteViewer(arguments);
  if (!written) return ReportError(written.error());
  std::fprintf(stderr,
               "farhorizon: %s/viewer.html is written; browsers need a web server to show it, say\n"
               "  python3 -m http.server -b 127.0.0.1 -d %s\n",
               arguments.directory.c_str(), arguments.directory.c_str());
  return kExitDone;
}

}  // namespace

void AddViewer(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<ViewerArguments>();
  Command command = program.AddCommand(
      "viewer", "Put a page beside artifacts that shows them on any web server, with CesiumJS");
  command.Add({.names = "DIR", .type = "", .help = "the folder of the artifacts", .required = true},
              arguments->directory);
  command.Add({.names = "--cesium",
               .type = "FOLDER",
               .help = "CesiumJS, as service/pages/install-cesium makes it (the installed one)"},
              arguments->cesium);
  command.SetFooter("Writes DIR/viewer.html and DIR/cesium, 14 MB, which any copy of DIR needs.");
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
