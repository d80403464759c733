// A format is told by the bytes that its specification begins with, before GDAL sees the file, so
// that no driver is tried on what is not meant for it. Formats without such bytes come last: SRTM
// HGT by its name and size, USGS DEM by two fields of its header, points by their first lines.
#include "core/io/file_kind/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/io/file_kind/hgt_name.h"
#include "core/io/file_kind/unread_formats.h"
#include "core/io/text_grid/xyz_points.h"

namespace farhorizon {

namespace {

using namespace std::string_view_literals;

constexpr char kReadFormats[] =
    "GeoTIFF, SRTM HGT (by its name, such as N46E007.hgt, zipped, too), DTED, USGS DEM, Erdas "
    "Imagine, Arc/Info or GRASS ASCII grid, Surfer grid, a list of x, y and height on a grid, or "
    "numbers with the .hdr of ENVI or Esri beside";

bool IsTiff(std::string_view bytes) {
  return bytes.starts_with("II\x2a\x00"sv) || bytes.starts_with("MM\x00\x2a"sv) ||
         bytes.starts_with("II\x2b\x00\x08\x00"sv) || bytes.starts_with("MM\x00\x2b\x00\x08"sv);
}

// DTED may have a volume label and a header label, of 80 bytes each, before its user header label.
bool IsDted(std::string_view bytes) {
  constexpr std::size_t kLabelBytes = 80;
  for (int labels = 0; labels < 3; ++labels) {
    if (bytes.starts_with("UHL1")) return true;
    if (!bytes.starts_with("VOL1") && !bytes.starts_with("HDR1")) return false;
    bytes.remove_prefix(std::min(bytes.size(), kLabelBytes));
  }
  return false;
}

// USGS DEM has no magic number. Like GDAL's driver this reads two numbers of the text header: the
// pattern of elevations at byte 150 and the planimetric reference system at byte 156.
bool IsUsgsDem(std::string_view bytes) {
  if (bytes.size() < 200) return false;
  const std::string_view system = bytes.substr(156, 6);
  const std::string_view pattern = bytes.substr(150, 6);
  return (system == "     0" || system == "     1" || system == "     2" || system == "     3" ||
          system == " -9999") &&
         (pattern == "     1" || pattern == "     4");
}

// The first word of a text, in lower case.
std::string FirstWord(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  const std::size_t start = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  bytes.remove_prefix(start);
  std::string word(bytes.substr(0, std::min(bytes.find_first_of(" \t\r\n"), std::size_t{64})));
  std::ranges::transform(word, word.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

bool IsOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

}  // namespace

FileKind KindOfFile(const FileFacts& file) {
  const std::string_view bytes = file.beginning;
  if (IsTiff(bytes)) return FileKind::kTiff;
  if (IsDted(bytes)) return FileKind::kDted;
  const std::string word = FirstWord(bytes);
  if (IsOneOf(word, {"ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter", "dx",
                     "dy", "cellsize", "nodata_value"})) {
    return FileKind::kArcGrid;
  }
  // "ncols:" and "ncols=4" are named as what they are where the header is read.
  if (word.starts_with("ncols") || word.starts_with("nrows")) return FileKind::kArcGrid;
  if (IsOneOf(word, {"north:", "south:", "east:", "west:", "rows:", "cols:"})) {
    return FileKind::kGrassGrid;
  }
  if (word == "dsaa") return FileKind::kSurferText;
  if (bytes.starts_with("DSBB")) return FileKind::kSurferBinary;
  if (bytes.starts_with("DSRB")) return FileKind::kSurfer7;
  if (bytes.starts_with("EHFA_HEADER_TAG")) return FileKind::kErdas;
  if (bytes.starts_with("PK\x03\x04") && HasEnding(file.filename, ".hgt.zip")) {
    return FileKind::kZippedHgt;
  }
  if (IsHgtName(file.filename) && IsHgtSize(file.bytes)) return FileKind::kHgt;
  if (IsUsgsDem(bytes)) return FileKind::kUsgsDem;
  if (LooksLikeXyz(bytes)) return FileKind::kXyz;
  return FileKind::kOther;
}

bool IsTextGrid(FileKind kind) {
  return kind == FileKind::kArcGrid || kind == FileKind::kGrassGrid ||
         kind == FileKind::kSurferText || kind == FileKind::kXyz;
}

Error UnreadFile(const FileFacts& file, const std::string& subject, const std::string& complaint) {
  const UnreadFormat* format = FindUnreadFormat(file.beginning, file.bytes, file.filename);
  if (HasEnding(file.filename, ".hgt") || (format == nullptr && IsHgtSize(file.bytes))) {
    if (std::optional<Error> fault = HgtFault(file.filename, file.bytes)) return *fault;
  }
  const std::string what =
      format != nullptr
          ? " is " + std::string(format->name) + complaint + "; " + std::string(format->remedy)
          : " is no raster that can be read" + complaint + "; expected " + kReadFormats;
  return {ErrorCode::kUnsupportedData, subject + what, "not-a-raster"};
}

}  // namespace farhorizon
