#include "core/io/raster/zipped_hgt.h"

#include <optional>
#include <string>

#include <cpl_string.h>
#include <cpl_vsi.h>

#include "core/io/file_kind/hgt_name.h"
#include "core/io/raster/sealed_folder.h"

namespace farhorizon {

namespace {

// Archives of one tile have a few files more at most; the list stops here.
constexpr int kMaxMembers = 64;

}  // namespace

Result<RasterPtr> OpenZippedHgt(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const SealedFolder folder({{name, path}});
  const std::string archive = "/vsizip/{" + folder.PathOf(name) + "}";
  const CPLStringList members(VSIReadDirEx(archive.c_str(), kMaxMembers));
  std::string tile;
  int tiles = 0;
  for (int i = 0; i < members.Count(); ++i) {
    if (!HasEnding(members[i], ".hgt")) continue;
    tile = members[i];
    ++tiles;
  }
  if (tiles != 1) {
    return Error{ErrorCode::kUnsupportedData,
                 "the zip archive has " + std::to_string(tiles) +
                     " HGT files at its root, one is needed; unpack it and give the tile",
                 "not-a-raster"};
  }
  const std::string inside = archive + "/" + tile;
  VSIStatBufL status;
  const bool known = VSIStatL(inside.c_str(), &status) == 0;
  if (std::optional<Error> fault = HgtFault(tile, known ? status.st_size : 0)) return *fault;
  return OpenWith(inside, "SRTMHGT");
}

}  // namespace farhorizon
