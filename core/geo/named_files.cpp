// Three forms: a PROJ string, words with blanks between; WKT and PROJJSON, which can hold PROJ
// strings (EXTENSION, REMARK, the name of a METHOD). PROJ tidies a string more than once before it
// reads it, each time by other rules (pj_shrink, PROJStringSyntaxParser): a blank before a `=`
// goes, `;` counts as a blank, `#` begins a comment. So a PROJ string must have the plain form, in
// which nothing is left to tidy; in the other forms words are looked for with all of that left out.
#include "core/geo/named_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <string>

#include "core/base/lower.h"

namespace farhorizon {

namespace {

constexpr const char* kNamesFile = "names a pipeline or a file, which is not allowed";
constexpr const char* kNamesGrid = "names a grid file, which is not allowed";
constexpr const char* kNamesGeoid =
    "names a geoid's file, which is not allowed: --vertical-datum names it";
constexpr const char* kBadForm =
    "is no plain PROJ string (words \"+name=value\" with blanks between, no blank beside \"=\")";

bool IsSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool IsNameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}
bool IsControl(char c) {
  return static_cast<unsigned char>(c) < 0x20 ? c != '\t' && c != '\n' && c != '\r' : c == 0x7f;
}

const char* NamesGridFor(std::string_view name) {
  return name.find("geoid") == std::string_view::npos ? kNamesGrid : kNamesGeoid;
}

// Web Mercator is written with +nadgrids=@null, which means no grid.
bool IsNoGrid(std::string_view name, std::string_view value) {
  return name == "nadgrids" && value == "@null";
}

// One word of a PROJ string, in lower case.
const char* NamedFileInWord(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const std::size_t equals = std::min(word.find('='), word.size());
  const std::string_view name = word.substr(0, equals);
  if (name.empty() || !std::ranges::all_of(name, IsNameCharacter)) return kBadForm;
  const bool has_value = equals < word.size();
  const std::string_view value = has_value ? word.substr(equals + 1) : "";
  if (name.find("grid") != std::string_view::npos && !IsNoGrid(name, value)) {
    return NamesGridFor(name);
  }
  for (const std::string_view part : {"file", "model", "catalog", "init", "step"}) {
    if (name.find(part) != std::string_view::npos) return kNamesFile;
  }
  if (!has_value) return nullptr;
  if (name == "proj") {
    for (const std::string_view part :
         {"pipeline", "shift", "tinshift", "deformation", "defmodel"}) {
      if (value.find(part) != std::string_view::npos) return kNamesFile;
    }
  }
  if (value.empty() || value.starts_with('"')) return kBadForm;
  if (value.find_first_of("/\\;#=|<>") != std::string_view::npos) return kNamesFile;
  return value.find('@') == std::string_view::npos || IsNoGrid(name, value) ? nullptr : kNamesFile;
}

const char* NamedFileInString(std::string_view lower) {
  while (!lower.empty()) {
    const auto start = std::ranges::find_if_not(lower, IsSpace);
    const auto end = std::find_if(start, lower.end(), IsSpace);
    if (start == lower.end()) break;
    if (const char* why = NamedFileInWord({start, end})) return why;
    lower = std::string_view(end, lower.end());
  }
  return nullptr;
}

// "grids", then nothing that is a letter, a digit or a bracket up to "=", then another value than
// @null.
const char* NamedGridAnywhere(std::string_view lower) {
  constexpr std::string_view kWord = "grids";
  constexpr std::string_view kNone = "@null";
  const auto is_filler = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '=' && c != ']' && c != '}';
  };
  for (std::size_t at = lower.find(kWord); at != std::string_view::npos;
       at = lower.find(kWord, at + 1)) {
    std::string_view rest = lower.substr(at + kWord.size());
    rest.remove_prefix(
        static_cast<std::size_t>(std::ranges::find_if_not(rest, is_filler) - rest.begin()));
    if (!rest.starts_with('=')) continue;
    rest.remove_prefix(1);
    const bool none =
        rest.starts_with(kNone) && (rest.size() == kNone.size() || IsSpace(rest[kNone.size()]) ||
                                    rest[kNone.size()] == '"' || rest[kNone.size()] == '+');
    if (!none) return NamesGridFor(lower.substr(std::max<std::size_t>(at, 5) - 5, 5));
  }
  return nullptr;
}

std::string Squeezed(std::string_view lower) {
  std::string squeezed;
  std::ranges::copy_if(lower, std::back_inserter(squeezed),
                       [](char c) { return !IsSpace(c) && c != '"' && c != '\''; });
  return squeezed;
}

const char* NamedFileAnywhere(std::string_view lower) {
  const std::string squeezed = Squeezed(lower);
  constexpr std::array<std::string_view, 11> kWords = {
      "proj=pipeline", "+step",       "init=",    "file=",    "model=", "catalog=",
      "parameterfile", "proj4_grids", "tinshift", "defmodel", "@http"};
  for (const std::string_view word : kWords) {
    if (squeezed.find(word) != std::string::npos) return kNamesFile;
  }
  const bool has_string = squeezed.find("proj=") != std::string::npos;
  if (has_string && squeezed.find_first_of(";#") != std::string::npos) return kNamesFile;
  return NamedGridAnywhere(lower);
}

// A file is a parameter of PROJJSON whose value is a text. An escape could stand for a letter of
// that key, or for a blank in a PROJ string.
const char* NamedFileInJson(std::string_view lower) {
  for (std::size_t at = lower.find('\\'); at != std::string_view::npos;
       at = lower.find('\\', at + 2)) {
    if (at + 1 >= lower.size() ||
        std::string_view("\"\\/").find(lower[at + 1]) == std::string_view::npos) {
      return "has an escape, as names of files may have";
    }
  }
  constexpr std::string_view kKey = "\"value\"";
  for (std::size_t at = lower.find(kKey); at != std::string_view::npos;
       at = lower.find(kKey, at + 1)) {
    const std::size_t value = lower.find_first_not_of(" \t\r\n:", at + kKey.size());
    if (value != std::string_view::npos && lower[value] == '"') {
      return "has a parameter that is a text, as names of files are";
    }
  }
  return nullptr;
}

}  // namespace

bool NamesFileSomewhere(std::string_view bytes) {
  const std::string lower = Lower(std::string(bytes));
  const std::string squeezed = Squeezed(lower);
  // Fewer words than of a definition: the bytes may be of anything.
  for (const std::string_view word :
       {"proj4_grids", "parameterfile", "init=", "proj-basedoperation", "projcrsstring"}) {
    if (squeezed.find(word) != std::string::npos) return true;
  }
  return NamedGridAnywhere(lower) != nullptr;
}

Error SystemNamesFile(const std::string& whose) {
  return {ErrorCode::kUnsupportedData,
          whose +
              " reference system names a file, which is not opened; state the system with a code: "
              "gdal_translate -a_srs EPSG:CODE IN OUT.tif",
          "unknown-crs"};
}

const char* NamedFileIn(std::string_view text) {
  const std::string lower = Lower(std::string(text));
  if (std::ranges::any_of(lower, IsControl)) return "has a control character";
  if (const char* why = NamedFileAnywhere(lower)) return why;
  const auto first = std::ranges::find_if_not(lower, IsSpace);
  if (first == lower.end()) return nullptr;
  if (*first == '{') return NamedFileInJson(lower);
  // WKT: a word, then a bracket; PROJ takes round ones, too.
  const auto after =
      std::find_if_not(std::find_if_not(first, lower.end(), IsNameCharacter), lower.end(), IsSpace);
  const bool is_wkt = after != first && after != lower.end() && (*after == '[' || *after == '(');
  const bool has_words = lower.find('=') != std::string::npos;
  return has_words && !is_wkt ? NamedFileInString(lower) : nullptr;
}

}  // namespace farhorizon
