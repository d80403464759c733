// Finds out which of the formats that this program reads a file has, and opens it so that GDAL
// opens no other file.
#include "core/io/dem/open_raster.h"

#include <fstream>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>

#include "core/io/dem/sealed_folder.h"
#include "core/io/dem/text_raster.h"
#include "core/io/file_kind/file_kind.h"
#include "core/io/file_kind/hgt_name.h"

namespace farhorizon {

namespace {

std::string Quoted(const std::filesystem::path& path) {
  std::string quoted(1, '"');
  return quoted.append(path.filename().string()).append(1, '"');
}

RasterPtr OpenWith(const std::string& path, const char* driver) {
  // INTERNAL: no world or .tab file; OVERVIEW_LEVEL: no OVERVIEW_FILE redirection (measured).
  const char* const options[] = {"OVERVIEW_LEVEL=NONE", "GEOREF_SOURCES=INTERNAL", nullptr};
  const char* const drivers[] = {driver, nullptr};
  return RasterPtr(
      GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, options, nullptr));
}

Result<std::string> ReadBeginning(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string beginning(kBeginningBytes, '\0');
  in.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  if (in.bad() || !in.is_open()) {
    return Error{ErrorCode::kIo, Quoted(path) + " cannot be opened", "io"};
  }
  beginning.resize(static_cast<std::size_t>(in.gcount()));
  return beginning;
}

// The first of `path` with another ending, and `path` with that added, that is a file.
std::optional<std::filesystem::path> Beside(const std::filesystem::path& path,
                                            std::initializer_list<const char*> endings) {
  std::error_code failure;
  for (const char* ending : endings) {
    std::filesystem::path replaced = path;
    for (const std::filesystem::path& beside :
         {replaced.replace_extension(ending), std::filesystem::path(path.string() + ending)}) {
      if (beside != path && std::filesystem::is_regular_file(beside, failure)) return beside;
    }
  }
  return std::nullopt;
}

// Numbers that a .hdr beside describes, which begins with "ENVI" or is Esri's.
RasterPtr OpenDescribed(const std::filesystem::path& path) {
  const std::optional<std::filesystem::path> header = Beside(path, {".hdr", ".HDR"});
  if (!header) return nullptr;
  Result<std::string> beginning = ReadBeginning(*header);
  const bool is_envi = beginning && beginning->starts_with("ENVI");
  std::vector<std::filesystem::path> files = {path, *header};
  if (const auto prj = Beside(path, {".prj", ".PRJ"}); prj && !is_envi) files.push_back(*prj);
  const SealedFolder folder(files);
  // GDAL sees files beside only without EMPTY_DIR.
  CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "TRUE");
  RasterPtr dataset = OpenWith(folder.NameOf(path), is_envi ? "ENVI" : "EHdr");
  CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
  return dataset;
}

RasterPtr OpenSealed(const std::filesystem::path& path, const char* driver) {
  const SealedFolder folder({path});
  return OpenWith(folder.NameOf(path), driver);
}

// The one HGT tile in the archive at `path`. GDAL inflates as much as the size in its directory
// says, which must be a tile's.
Result<RasterPtr> OpenZippedHgt(const std::filesystem::path& path) {
  constexpr int kMaxMembers = 64;
  const SealedFolder folder({path});
  const std::string archive = "/vsizip/{" + folder.NameOf(path) + "}";
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
                 Quoted(path) + " is a zip archive with " + std::to_string(tiles) +
                     " HGT files, one is needed; unpack it and give the tile",
                 "not-a-raster"};
  }
  const std::string name = archive + "/" + tile;
  VSIStatBufL status;
  const bool known = VSIStatL(name.c_str(), &status) == 0;
  if (std::optional<Error> fault = HgtFault(tile, known ? status.st_size : 0)) return *fault;
  return OpenWith(name, "SRTMHGT");
}

// What the path names where that is no file.
Error NoFile(const std::filesystem::path& path) {
  const std::string text = path.string();
  std::error_code failure;
  if (text.find("://") != std::string::npos || text.starts_with("/vsicurl")) {
    return {ErrorCode::kNotFound,
            "there is no file of that name; it is an address: fetch the DEM from there first, and "
            "give the file",
            "no-such-file"};
  }
  if (std::filesystem::is_directory(path, failure)) {
    return {ErrorCode::kNotFound,
            Quoted(path) +
                " is a folder; give the DEM in it (a folder that is itself a raster, such as an "
                "Arc/Info binary grid, becomes one file with gdal_translate FOLDER OUT.tif)",
            "no-such-file"};
  }
  return {ErrorCode::kNotFound, "there is no file " + Quoted(path), "no-such-file"};
}

// Null where the driver does not take the file.
Result<RasterPtr> OpenOfKind(const std::filesystem::path& path, FileKind kind) {
  switch (kind) {
    case FileKind::kTiff:
      return OpenWith(path.string(), "GTiff");
    case FileKind::kDted:
      return OpenWith(path.string(), "DTED");
    case FileKind::kUsgsDem:
      return OpenWith(path.string(), "USGSDEM");
    case FileKind::kHgt:
      return OpenWith(path.string(), "SRTMHGT");
    case FileKind::kZippedHgt:
      return OpenZippedHgt(path);
    case FileKind::kErdas:
      return OpenSealed(path, "HFA");
    case FileKind::kSurferBinary:
      return OpenSealed(path, "GSBG");
    case FileKind::kSurfer7:
      return OpenSealed(path, "GS7BG");
    default:
      return OpenDescribed(path);
  }
}

}  // namespace

void CloseRaster::operator()(void* dataset) const { GDALClose(dataset); }

Result<OpenedRaster> OpenRaster(const std::filesystem::path& path, std::int64_t max_cells,
                                GdalSession& session) {
  std::error_code failure;
  const std::filesystem::path absolute = std::filesystem::absolute(path).lexically_normal();
  if (!std::filesystem::is_regular_file(path, failure)) return NoFile(path);
  if (absolute.string().starts_with("/vsi")) {
    return Error{ErrorCode::kInvalidArgument, "paths under /vsi are GDAL's, not files of ours",
                 "virtual-path"};
  }
  Result<std::string> beginning = ReadBeginning(path);
  if (!beginning) return std::move(beginning.error());
  const std::string filename = path.filename().string();
  const FileFacts facts = {
      *beginning, static_cast<std::int64_t>(std::filesystem::file_size(path, failure)), filename};
  const FileKind kind = KindOfFile(facts);
  if (IsTextGrid(kind)) return OpenTextRaster(path, kind, max_cells);
  Result<RasterPtr> dataset = OpenOfKind(absolute, kind);
  if (!dataset) return std::move(dataset.error());
  if (!*dataset) return UnreadFile(facts, Quoted(path), session.Complaint());
  session.Forget();
  return OpenedRaster{std::move(*dataset)};
}

}  // namespace farhorizon
