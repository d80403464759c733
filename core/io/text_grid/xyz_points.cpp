// Lists of points have no standard: what parts the fields and whether the first line has names is
// found from that line, and every later one must follow it.
#include "core/io/text_grid/xyz_points.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "core/io/text_grid/grid_header.h"
#include "core/io/text_grid/text_number.h"

namespace farhorizon {

namespace {

struct AxisName {
  std::string_view name;
  int axis = 0;
};
constexpr auto kAxisNames = std::to_array<AxisName>({
    {"x", 0},         {"e", 0},   {"east", 0},     {"easting", 0}, {"lon", 0},       {"long", 0},
    {"longitude", 0}, {"y", 1},   {"n", 1},        {"north", 1},   {"northing", 1},  {"lat", 1},
    {"latitude", 1},  {"z", 2},   {"h", 2},        {"height", 2},  {"elevation", 2}, {"elev", 2},
    {"ele", 2},       {"alt", 2}, {"altitude", 2}, {"value", 2},   {"dem", 2},
});

// Which of the columns x, y, height a name means, whatever unit it has in brackets; nullopt for any
// other.
std::optional<int> AxisOf(std::string name) {
  name.resize(std::min(name.find_first_of("(["), name.size()));
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* const found = std::ranges::find(kAxisNames, name, &AxisName::name);
  return found != kAxisNames.end() ? std::optional(found->axis) : std::nullopt;
}

// Whether a name has a unit in brackets that is not the metre.
bool HasOtherUnit(const std::string& name) {
  std::string unit = name.substr(std::min(name.find_first_of("(["), name.size()));
  std::erase_if(unit, [](unsigned char c) { return std::isalpha(c) == 0; });
  std::ranges::transform(unit, unit.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static constexpr auto kMetres =
      std::to_array<std::string_view>({"", "m", "meter", "meters", "metre", "metres", "masl"});
  return std::ranges::find(kMetres, unit) == kMetres.end();
}

bool IsColumn(const std::string& name) { return AxisOf(name).has_value(); }

// What parts the numbers of a line beside white space: ';', ',', or nothing more.
char SeparatorOf(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  return std::ranges::count(line, ',') == 2 ? ',' : ' ';
}

std::string_view FirstLine(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text.substr(0, text.find_first_of("\r\n"));
}

// The fields of a line; those without a letter or digit (the "#" of a comment) are left out. Names
// may have blanks inside where something else parts them.
std::vector<std::string> Fields(std::string_view line) {
  const char separator = SeparatorOf(line);
  const std::string apart = separator == ' ' ? " \t" : std::string(1, separator);
  std::vector<std::string> fields;
  while (!line.empty() && fields.size() < 5) {
    const std::string_view field = line.substr(0, line.find_first_of(apart));
    line.remove_prefix(std::min(field.size() + 1, line.size()));
    if (std::ranges::none_of(field, [](unsigned char c) { return std::isalnum(c) != 0; })) continue;
    const std::size_t first = field.find_first_not_of(" \t");
    fields.emplace_back(field.substr(first, field.find_last_not_of(" \t") + 1 - first));
  }
  return fields;
}

bool AllNumbers(const std::vector<std::string>& fields) {
  return std::ranges::all_of(
      fields, [](const std::string& field) { return ParseNumber(field).has_value(); });
}

Error BadLine(const TextWord& word, const std::string& what) {
  return BadGrid("the list of points has " + QuotedWord(word.text) + " in " + PlaceOf(word) + ", " +
                 what + "; each line must be the three numbers x, y and height");
}

}  // namespace

bool LooksLikeXyz(std::string_view beginning) {
  std::string_view rest = beginning;
  int points = 0;
  for (int lines = 0; lines < 3 && points < 2; ++lines) {
    const std::string_view line = FirstLine(rest);
    const auto end = static_cast<std::size_t>(line.data() + line.size() - rest.data());
    if (end >= rest.size() && points == 0) return false;  // no whole line
    const std::vector<std::string> fields = Fields(line);
    if (fields.size() != 3) return false;
    if (AllNumbers(fields)) {
      ++points;
    } else if (lines > 0 || !std::ranges::all_of(fields, IsColumn)) {
      return false;
    }
    rest.remove_prefix(std::min(end, rest.size()));
  }
  return points == 2;
}

Result<XyzPoints> XyzPoints::Open(const std::filesystem::path& path) {
  Result<TextWords> words = TextWords::Open(path);
  if (!words) return std::move(words.error());
  XyzPoints points(std::move(*words));
  if (Status begun = points.ReadHeader(); !begun) return std::move(begun.error());
  return points;
}

Status XyzPoints::ReadHeader() {
  const std::string first(FirstLine(words_.Ahead()));
  words_.SeparateAt(SeparatorOf(first));
  more_ = words_.Next(word_);
  const std::vector<std::string> names = Fields(first);
  if (!more_ || names.empty() || ParseNumber(names[0])) return Ok{};
  std::array<bool, 3> named{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::optional<int> axis = AxisOf(names[i]);
    if (i >= 3 || !axis || named[static_cast<std::size_t>(*axis)]) {
      return BadGrid("the list of points has a column " + QuotedWord(names[i]) +
                     "; it must have three, x (easting, longitude), y (northing, latitude) and "
                     "height");
    }
    if (*axis == 2 && HasOtherUnit(names[i])) {
      return BadGrid("the list of points has heights in a unit of its own, " +
                     QuotedWord(names[i]) +
                     "; name that column height, and state the unit with --height-unit");
    }
    axes_[i] = *axis;
    named[static_cast<std::size_t>(*axis)] = true;
  }
  const std::int64_t line = word_.line;
  while (more_ && word_.line == line) more_ = words_.Next(word_);
  order_is_stated_ = true;
  return Ok{};
}

Result<std::optional<XyzPoint>> XyzPoints::Next() {
  using Point = std::optional<XyzPoint>;
  if (!more_) return Point();
  XyzPoint point{};
  line_ = word_.line;
  for (std::size_t i = 0; i < 3; ++i, more_ = words_.Next(word_)) {
    if (!more_ || word_.line != line_) {
      return BadGrid("the list of points has " + std::to_string(i) + " numbers in line " +
                     std::to_string(line_) +
                     "; each line must be the three numbers x, y and height");
    }
    const std::optional<TextNumber> number = ParseNumber(word_.text);
    if (!number || number->comma == CommaUse::kEither) {
      return BadLine(word_, "which is no number");
    }
    const auto axis = static_cast<std::size_t>(axes_[i]);
    if (axis < 2 && !std::isfinite(number->value)) return BadLine(word_, "which is no place");
    point[axis] = number->value;
  }
  if (more_ && word_.line == line_) return BadLine(word_, "which is a fourth column");
  return Point(point);
}

}  // namespace farhorizon
