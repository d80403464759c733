#include "core/geo/crs_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace farhorizon {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} * 1024;
constexpr std::size_t kMaxShownBytes = 60;

// Texts that make PROJ open something by name, in lower case.
constexpr std::array<std::string_view, 9> kNamesAFile = {
    "proj=pipeline", "+step",  "+init=",        "init=", "geoidgrids=",
    "+grids=",       "+file=", "parameterfile", "@http"};

std::string Lower(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

// WKT and PROJJSON have URLs as citations, which PROJ does not follow.
bool IsStructured(std::string_view lower) {
  return lower.starts_with('{') || lower.find('[') != std::string_view::npos;
}

Error Refused(std::string_view text, const std::string& why) {
  std::string shown(text.substr(0, kMaxShownBytes));
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  if (text.size() > kMaxShownBytes) shown += "...";
  return {ErrorCode::kUnsupportedData,
          "reference system \"" + shown + "\" " + why + "; give a code such as EPSG:4326, or WKT",
          "unknown-crs"};
}

}  // namespace

Status CheckCrsText(const std::string& text) {
  const std::string lower = Lower(text);
  if (std::ranges::all_of(lower, [](unsigned char c) { return std::isspace(c) != 0; })) {
    return Error{ErrorCode::kUnsupportedData,
                 "the DEM has no reference system; name it with --crs, for example EPSG:4326",
                 "no-crs"};
  }
  if (text.size() > kMaxBytes) return Refused(text, "is longer than 64 KiB");
  for (const std::string_view word : kNamesAFile) {
    if (lower.find(word) != std::string::npos) {
      return Refused(text, "names a pipeline or a file, which is not allowed");
    }
  }
  // Web Mercator is written with +nadgrids=@null, which means no grid; any other value names one.
  for (std::size_t at = lower.find("nadgrids="); at != std::string::npos;
       at = lower.find("nadgrids=", at + 1)) {
    if (lower.compare(at + 9, 5, "@null") != 0) {
      return Refused(text, "names a grid file, which is not allowed");
    }
  }
  if (IsStructured(lower)) return Ok{};
  if (lower.find("://") != std::string::npos) return Refused(text, "is a URL");
  if (lower.starts_with('/') || lower.starts_with('.') || lower.starts_with('~') ||
      lower.find('\\') != std::string::npos || lower.find("..") != std::string::npos) {
    return Refused(text, "is a path");
  }
  return Ok{};
}

}  // namespace farhorizon
