// Two passes over a text that may come from a stranger: the first completes what people write for
// codes, the second refuses whatever would make PROJ open a file or a URL.
#include "core/geo/crs_text.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <string_view>

#include "core/base/lower.h"
#include "core/geo/named_files.h"
#include "core/geo/short_text.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} * 1024;
constexpr std::size_t kMaxShownBytes = 60;
// No text of the forms that are completed is longer; std::regex needs a stack that grows with it.
constexpr std::size_t kMaxCompletedBytes = 500;

bool IsSpace(unsigned char c) { return std::isspace(c) != 0; }

std::string Trimmed(const std::string& text) {
  const auto first = std::ranges::find_if_not(text, IsSpace);
  const auto last = std::find_if_not(text.rbegin(), text.rend(), IsSpace).base();
  return first < last ? std::string(first, last) : "";
}

// WKT and PROJJSON have URLs as citations, which PROJ does not follow.
bool IsStructured(std::string_view lower) {
  return lower.starts_with('{') || lower.find('[') != std::string_view::npos;
}

// "EPSG:4326" of "epsg: 4326", "EPSG::4326", "EPSG 4326", "4326"; "" of anything else.
std::string CodeIn(const std::string& text) {
  static const std::regex number(R"(\d{4,6})");
  static const std::regex code(R"((epsg|esri|ignf|ogc)\s*(?::{1,2}|\s)\s*([a-z0-9]+))",
                               std::regex::icase | std::regex::optimize);
  std::smatch part;
  if (std::regex_match(text, number)) return "EPSG:" + text;
  if (!std::regex_match(text, part, code)) return "";
  std::string authority = part[1];
  for (char& c : authority) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return authority + ":" + part[2].str();
}

Error Refused(const std::string& text, CrsRole role, const std::string& why) {
  return {ErrorCode::kUnsupportedData,
          ShownCrsText(text, role) + " " + why + "; " + RemedyFor(role), "unknown-crs"};
}

}  // namespace

std::string CompletedCrsText(const std::string& text) {
  const std::string trimmed = Trimmed(text);
  if (trimmed.size() > kMaxCompletedBytes) return trimmed;
  if (std::string code = CodeIn(trimmed); !code.empty()) return code;
  const std::string lower = Lower(trimmed);
  if (IsStructured(lower)) return trimmed;
  // A blank is what became of a plus in a URL.
  for (const char* joints : {"+,", " "}) {
    const std::size_t joint = trimmed.find_last_of(joints);
    if (joint == std::string::npos) continue;
    const std::string plan = CodeIn(Trimmed(trimmed.substr(0, joint)));
    const std::string heights = CodeIn(Trimmed(trimmed.substr(joint + 1)));
    if (!plan.empty() && !heights.empty()) {
      const std::string authority = plan.substr(0, plan.find(':') + 1);
      return plan + "+" +
             (heights.starts_with(authority) ? heights.substr(authority.size()) : heights);
    }
  }
  // OGC's name of a code; PROJ knows it without asking a server.
  static const std::regex url(R"(https?://www\.opengis\.net/def/crs/(\w+)/[\w.]+/(\w+))",
                              std::regex::icase);
  if (std::smatch name; std::regex_match(trimmed, name, url)) {
    return name[1].str() + ":" + name[2].str();
  }
  static const std::regex init(R"(\+?init=epsg:(\d+)(\s+\+?(type=crs|no_defs|wktext))*)");
  std::smatch part;
  if (std::regex_match(lower, part, init)) return "EPSG:" + part[1].str();
  static const std::regex proj_string(R"((\+?\w+(=\S*)?\s+)*\+?proj=[\s\S]*)");
  if (std::regex_match(lower, proj_string) && lower.find("type=crs") == std::string::npos) {
    return trimmed + " +type=crs";
  }
  return trimmed;
}

Status CheckCrsText(const std::string& text, CrsRole role) {
  const std::string lower = Lower(text);
  if (std::ranges::all_of(lower, IsSpace)) {
    return Error{ErrorCode::kUnsupportedData,
                 role == CrsRole::kHeights
                     ? std::string("no vertical datum is named; ") + RemedyFor(role)
                     : "the DEM has no reference system; name it with --crs, for example EPSG:4326",
                 "no-crs"};
  }
  if (text.size() > kMaxBytes) return Refused(text, role, "is longer than 64 KiB");
  if (const char* why = NamedFileIn(text)) return Refused(text, role, why);
  if (IsStructured(lower)) return Ok{};
  if (lower.find("://") != std::string::npos) return Refused(text, role, "is a URL");
  if (lower.starts_with('/') || lower.starts_with('.') || lower.starts_with('~') ||
      lower.find('\\') != std::string::npos || lower.find("..") != std::string::npos) {
    return Refused(text, role, "is a path");
  }
  return Ok{};
}

std::string ShownCrsText(const std::string& text, CrsRole role) {
  return (role == CrsRole::kHeights ? "vertical datum \"" : "reference system \"") +
         ShortText(text, kMaxShownBytes) + "\"";
}

const char* RemedyFor(CrsRole role) {
  return role == CrsRole::kHeights
             ? "give --vertical-datum a code such as EPSG:5773 (EGM96 height), or \"ellipsoid\""
             : "give --crs a code such as EPSG:4326, or WKT";
}

}  // namespace farhorizon
