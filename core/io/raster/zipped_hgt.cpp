#include "core/io/raster/zipped_hgt.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <cpl_string.h>
#include <cpl_vsi.h>

#include "core/io/file_kind/hgt_name.h"
#include "core/io/raster/sealed_folder.h"

namespace farhorizon {

namespace {

// Archives of one tile have a few files more at most; the list stops here.
constexpr int kMaxMembers = 64;

// Whether `bytes` bytes can be unpacked. GDAL 3.6's driver trusts the archive's list of contents:
// it reads from a null handle where the member itself cannot be opened (found by fuzzing).
bool Unpacks(const std::string& member, std::int64_t bytes) {
  VSILFILE* file = VSIFOpenL(member.c_str(), "rb");
  if (file == nullptr) return false;
  std::vector<char> piece(std::size_t{1} << 16U);
  std::int64_t read = 0;
  for (std::size_t got = 1; got > 0 && read <= bytes; read += static_cast<std::int64_t>(got)) {
    got = VSIFReadL(piece.data(), 1, piece.size(), file);
  }
  VSIFCloseL(file);
  return read == bytes;
}

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
  if (!Unpacks(inside, status.st_size)) {
    return Error{ErrorCode::kUnsupportedData,
                 "the zip archive is damaged: " + tile + " cannot be unpacked; fetch it again",
                 "truncated"};
  }
  return OpenWith(inside, "SRTMHGT");
}

}  // namespace farhorizon
