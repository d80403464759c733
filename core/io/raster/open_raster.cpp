// Finds out which of the formats that this program reads a file has, and opens it so that GDAL
// opens no other file.
#include "core/io/raster/open_raster.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>

#include "core/geo/named_files.h"
#include "core/io/file.h"
#include "core/io/file_kind/file_kind.h"
#include "core/io/file_kind/hgt_name.h"
#include "core/io/file_kind/unread_formats.h"
#include "core/io/raster/described_raster.h"
#include "core/io/raster/sealed_folder.h"
#include "core/io/raster/text_raster.h"
#include "core/io/raster/zipped_hgt.h"

namespace farhorizon {

namespace {

std::string Quoted(const std::filesystem::path& path) {
  std::string quoted(1, '"');
  return quoted.append(path.filename().string()).append(1, '"');
}

// For a header that is given in place of the raster beside it.
Error HeaderAlone(const std::filesystem::path& path) {
  std::error_code failure;
  std::string beside = "the file of the same name with another ending";
  for (const char* ending : {"", ".bil", ".flt", ".bip", ".bsq", ".dem", ".img", ".dat", ".raw"}) {
    std::filesystem::path raster = path;
    raster.replace_extension(ending);
    if (std::filesystem::is_regular_file(raster, failure)) beside = Quoted(raster);
  }
  return {ErrorCode::kUnsupportedData,
          Quoted(path) + " is the header of a raster; give the raster itself, " + beside,
          "not-a-raster"};
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

RasterPtr OpenSealed(const std::filesystem::path& path, const char* driver) {
  const std::string name = path.filename().string();
  const SealedFolder folder({{name, path}});
  return OpenWith(folder.PathOf(name), driver);
}

std::string BeginningOf(const std::filesystem::path& path, std::size_t at_most) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(at_most, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

// The driver opens a file whose tree is cut as far as that goes, with complaints.
Result<RasterPtr> OpenErdas(const std::filesystem::path& path, const GdalSession& session) {
  const std::string tree = BeginningOf(path, std::size_t{1} << 20U);
  if (NamesFileSomewhere(tree)) return SystemNamesFile("the raster's");
  RasterPtr dataset = OpenSealed(path, "HFA");
  if (!dataset || session.Failed()) {
    return Error{ErrorCode::kUnsupportedData,
                 "the raster is not complete: its Erdas Imagine tree is damaged or cut short; "
                 "fetch or make the file again",
                 "truncated"};
  }
  // The node that names such a file stands in the tree, which lies before the cells of a raster
  // that has them elsewhere.
  if (tree.find("ExternalRasterDMS") != std::string::npos) {
    return Error{ErrorCode::kUnsupportedData,
                 "the raster keeps its cells in another file (.ige), which is not opened; put them "
                 "into one file with gdal_translate IN.img OUT.tif",
                 "not-a-raster"};
  }
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

// Null where the driver does not take the file.
Result<RasterPtr> OpenOfKind(const std::filesystem::path& path, FileKind kind,
                             const GdalSession& session) {
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
      return OpenErdas(path, session);
    case FileKind::kSurferBinary:
      return OpenSealed(path, "GSBG");
    case FileKind::kSurfer7:
      return OpenSealed(path, "GS7BG");
    default:
      return OpenDescribedRaster(path, session);
  }
}

// Files of numbers alone have any first bytes, also those that mark another format.
bool MayBeNumbersAlone(const std::string& filename) {
  constexpr std::array kEndings = {".bil", ".bip", ".bsq", ".flt", ".img", ".dat", ".raw", ".bin"};
  return std::ranges::any_of(
      kEndings, [&filename](const char* ending) { return HasEnding(filename, ending); });
}

}  // namespace

Result<OpenedRaster> OpenRaster(const std::filesystem::path& path, const GridLimits& limits,
                                GdalSession& session) {
  std::error_code failure;
  const std::filesystem::path absolute = AbsolutePath(path);
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
  if (HasEnding(filename, ".hdr")) return HeaderAlone(path);
  const FileKind kind = KindOfFile(facts);
  if (kind == FileKind::kOther && !MayBeNumbersAlone(filename) &&
      FindUnreadFormat(*beginning, facts.bytes, filename) != nullptr) {
    return UnreadFile(facts, Quoted(path), "");
  }
  if (IsTextGrid(kind)) return OpenTextRaster(path, kind, limits);
  Result<RasterPtr> dataset = OpenOfKind(absolute, kind, session);
  if (!dataset) return std::move(dataset.error());
  if (!*dataset) return UnreadFile(facts, Quoted(path), session.Complaint());
  session.Forget();
  return OpenedRaster{.dataset = std::move(*dataset)};
}

}  // namespace farhorizon
