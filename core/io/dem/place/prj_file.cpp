#include "core/io/dem/place/prj_file.h"

#include <cstdlib>
#include <sstream>
#include <string_view>
#include <utility>

#include <cpl_string.h>
#include <ogr_srs_api.h>

#include "core/geo/named_files.h"
#include "core/io/dem/place/world_file.h"
#include "core/io/file.h"

namespace farhorizon {

namespace {

constexpr std::uintmax_t kMostPrjBytes = 65536;  // as CheckCrsText

CrsPtr CrsIn(const std::string& text) {
  if (NamedFileIn(text) != nullptr) return nullptr;
  CrsPtr crs(OSRNewSpatialReference(nullptr));
  CPLStringList lines(CSLTokenizeString2(text.c_str(), "\r\n", 0));
  const bool read = lines.Count() > 0 && OSRImportFromESRI(crs.get(), lines.List()) == OGRERR_NONE;
  return read ? std::move(crs) : nullptr;
}

}  // namespace

std::optional<PrjFile> FindPrjFile(const std::filesystem::path& path) {
  const std::optional<std::filesystem::path> beside = FindBeside(path, ".prj");
  if (!beside) return std::nullopt;
  Result<std::string> text = ReadFile(*beside, kMostPrjBytes);
  if (!text) return PrjFile{beside->filename().string(), "", nullptr};
  CrsPtr crs = CrsIn(*text);
  return PrjFile{beside->filename().string(), *std::move(text), std::move(crs)};
}

void SayUnreadOf(const PrjFile& prj, Assumptions& assumptions) {
  std::istringstream words(prj.text);
  for (std::string word; words >> word;) {
    if (!EQUAL(word.c_str(), "Zunits") || !(words >> word)) continue;
    if (STARTS_WITH_CI(word.c_str(), "met") || STARTS_WITH_CI(word.c_str(), "no")) continue;
    assumptions.push_back({"prj-file", prj.name + " says that heights are in " +
                                           word.substr(0, 20) +
                                           ", which was not read; state it with --height-unit"});
  }
  constexpr std::string_view kShift = "\"Vertical_Shift\",";
  const std::size_t at = prj.text.find(kShift);
  if (at == std::string::npos) return;
  const double shift = std::strtod(prj.text.c_str() + at + kShift.size(), nullptr);
  if (shift != 0) {
    assumptions.push_back({"prj-file", prj.name + " shifts heights by " + std::to_string(shift) +
                                           ", which was not done; put it in with gdal_translate "
                                           "-a_offset"});
  }
}

void SayPassedOver(const PrjFile& prj, void* own, Assumptions& assumptions) {
  if (!prj.crs) return;
  const bool more = OSRIsCompound(prj.crs.get()) != 0 && OSRIsCompound(own) == 0;
  if (!more && SameHorizontally(own, prj.crs.get())) return SayUnreadOf(prj, assumptions);
  assumptions.push_back({"prj-file", prj.name + " beside the raster names " +
                                         (more ? "a vertical system, too; the raster's own system"
                                               : "another reference system than the raster itself, "
                                                 "which") +
                                         " was taken; state the right one with --crs, or move the "
                                         ".prj away"});
}

}  // namespace farhorizon
