// Finds out which of the formats that this program reads a file has, and opens it so that GDAL
// opens no other file.
#include "core/io/dem/open_raster.h"

#include <fstream>
#include <string>
#include <utility>

#include <cpl_conv.h>
#include <gdal.h>

#include "core/io/dem/text_raster.h"
#include "core/io/file_kind/file_kind.h"

namespace farhorizon {

namespace {

std::string Quoted(const std::filesystem::path& path) {
  std::string quoted(1, '"');
  return quoted.append(path.filename().string()).append(1, '"');
}

RasterPtr OpenWith(const std::string& path, const char* const* drivers) {
  // INTERNAL: no world or .tab file; OVERVIEW_LEVEL: no OVERVIEW_FILE redirection (measured).
  const char* const options[] = {"OVERVIEW_LEVEL=NONE", "GEOREF_SOURCES=INTERNAL", nullptr};
  return RasterPtr(
      GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, options, nullptr));
}

RasterPtr OpenEnvi(const std::string& path) {
  // ENVI keeps its header in a file beside, which GDAL sees only without EMPTY_DIR.
  CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "TRUE");
  const char* const envi[] = {"ENVI", nullptr};
  RasterPtr dataset = OpenWith(path, envi);
  CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
  return dataset;
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

}  // namespace

void CloseRaster::operator()(void* dataset) const { GDALClose(dataset); }

Result<RasterPtr> OpenRaster(const std::filesystem::path& path, std::int64_t max_cells,
                             GdalSession& session) {
  std::error_code failure;
  const std::string absolute = std::filesystem::absolute(path).lexically_normal().string();
  if (!std::filesystem::is_regular_file(path, failure)) return NoFile(path);
  if (absolute.starts_with("/vsi")) {
    return Error{ErrorCode::kInvalidArgument, "paths under /vsi are GDAL's, not files of ours",
                 "virtual-path"};
  }
  Result<std::string> beginning = ReadBeginning(path);
  if (!beginning) return std::move(beginning.error());
  const std::string filename = path.filename().string();
  const FileFacts facts = {
      *beginning, static_cast<std::int64_t>(std::filesystem::file_size(path, failure)), filename};
  const FileKind kind = KindOfFile(facts);
  if (kind == FileKind::kArcGrid) return OpenTextRaster(path, kind, max_cells);
  const char* const alone[] = {"GTiff", "SRTMHGT", "DTED", "USGSDEM", nullptr};
  RasterPtr dataset = OpenWith(absolute, alone);
  if (!dataset) {
    const std::string complaint = session.Complaint();
    dataset = OpenEnvi(absolute);
    if (!dataset) return UnreadFile(facts, Quoted(path), complaint);
  }
  session.Forget();
  return dataset;
}

}  // namespace farhorizon
