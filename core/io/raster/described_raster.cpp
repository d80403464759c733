#include "core/io/raster/described_raster.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <cpl_conv.h>

#include "core/geo/named_files.h"
#include "core/io/file.h"
#include "core/io/raster/sealed_folder.h"
#include "core/io/text_grid/esri_header.h"

namespace farhorizon {

namespace {

// More than any header has, and little enough to be read at once.
constexpr std::uintmax_t kMaxHeaderBytes = std::uintmax_t{1} << 20U;

// The file beside `path` with that ending in place of its own, or after it.
std::optional<std::filesystem::path> Beside(const std::filesystem::path& path,
                                            const std::string& ending, const std::string& capital) {
  std::error_code failure;
  for (const std::string& end : {ending, capital}) {
    std::filesystem::path replaced = path;
    replaced.replace_extension(end);
    for (const std::filesystem::path& beside :
         {replaced, std::filesystem::path(path.string() + end)}) {
      if (beside != path && std::filesystem::is_regular_file(beside, failure)) return beside;
    }
  }
  return std::nullopt;
}

}  // namespace

Result<RasterPtr> OpenDescribedRaster(const std::filesystem::path& path,
                                      const GdalSession& session) {
  const std::optional<std::filesystem::path> header = Beside(path, ".hdr", ".HDR");
  if (!header) return RasterPtr();
  Result<std::string> text = ReadFile(*header, kMaxHeaderBytes);
  if (!text) return std::move(text.error());
  const bool is_envi = text->starts_with("ENVI");
  if (is_envi && NamesFileSomewhere(*text)) return SystemNamesFile("the header's");
  const std::string name = path.filename().string();
  const std::string stem = path.stem().string();
  std::vector<SealedFolder::Member> members = {{name, path}, {stem + ".hdr", *header}};
  if (!is_envi) {
    std::error_code failure;
    const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(path, failure));
    if (Status sound = CheckEsriHeader(*header, bytes); !sound) return std::move(sound.error());
    if (const auto prj = Beside(path, ".prj", ".PRJ")) {
      const Result<std::string> system = ReadFile(*prj, kMaxHeaderBytes);
      if (system && NamesFileSomewhere(*system)) return SystemNamesFile("the .prj's");
      members.push_back({stem + ".prj", *prj});
    }
  }
  const SealedFolder folder(members);
  // GDAL sees files beside only without EMPTY_DIR.
  CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "TRUE");
  RasterPtr dataset = OpenWith(folder.PathOf(name), is_envi ? "ENVI" : "EHdr");
  CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
  if (dataset) return dataset;
  return Error{ErrorCode::kUnsupportedData,
               "the header beside the raster, \"" + header->filename().string() +
                   "\", is not one that can be read" + session.Complaint() +
                   "; expected that of ENVI or of an Esri raster",
               "not-a-raster"};
}

}  // namespace farhorizon
