// The first pass finds the extent and the spacing, the second puts each height into its cell.
// Spacing: the mean of the steps that are about as long as the shortest, since rounding makes
// single steps too short or too long; then the extent is divided into whole cells.
#include "core/io/text_grid/xyz_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/io/text_grid/body_cells.h"
#include "core/io/text_grid/grid_header.h"
#include "core/io/text_grid/text_number.h"
#include "core/io/text_grid/text_words.h"

namespace farhorizon {

namespace {

constexpr char kScattered[] =
    "; make a grid of its points first, with gdal_grid or pdal (writers.gdal)";

// Which of the columns x, y, height a name means, whatever unit it has in brackets; nullopt for any
// other.
std::optional<int> AxisOf(std::string name) {
  name.resize(std::min(name.find_first_of("(["), name.size()));
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static const std::vector<std::vector<std::string_view>> kNames = {
      {"x", "e", "east", "easting", "lon", "long", "longitude"},
      {"y", "n", "north", "northing", "lat", "latitude"},
      {"z", "h", "height", "elevation", "elev", "ele", "alt", "altitude", "value", "dem"}};
  for (int axis = 0; axis < 3; ++axis) {
    const auto& names = kNames[static_cast<std::size_t>(axis)];
    if (std::ranges::find(names, name) != names.end()) return axis;
  }
  return std::nullopt;
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

// The lines of a list, one point each.
class XyzReader {
 public:
  static Result<XyzReader> Open(const std::filesystem::path& path) {
    Result<TextWords> plain = TextWords::Open(path);
    if (!plain) return std::move(plain.error());
    XyzReader reader(std::move(*plain));
    if (Status begun = reader.ReadHeader(); !begun) return std::move(begun.error());
    return reader;
  }

  [[nodiscard]] bool order_is_stated() const { return order_is_stated_; }
  [[nodiscard]] std::int64_t line() const { return line_; }

  // The next point as x, y, height; nullopt at the end.
  Result<std::optional<std::array<double, 3>>> Next();

 private:
  explicit XyzReader(TextWords words) : words_(std::move(words)) {}
  Status ReadHeader();
  [[nodiscard]] Error BadLine(const TextWord& word, const std::string& what) const {
    return BadGrid("the list of points has " + QuotedWord(word.text) + " in " + PlaceOf(word) +
                   ", " + what + "; each line must be the three numbers x, y and height");
  }

  TextWords words_;
  std::array<int, 3> axes_ = {0, 1, 2};
  bool order_is_stated_ = false;
  std::int64_t line_ = 0;
  TextWord word_;  // the first of the next line
  bool more_ = false;
};

Status XyzReader::ReadHeader() {
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

Result<std::optional<std::array<double, 3>>> XyzReader::Next() {
  using Point = std::optional<std::array<double, 3>>;
  if (!more_) return Point();
  std::array<double, 3> point{};
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

// Extent and spacing along an axis, from all its coordinates in the order of the list.
class Axis {
 public:
  void Take(double at) {
    if (any_ && at != last_) TakeStep(std::abs(at - last_));
    low_ = any_ ? std::min(low_, at) : at;
    high_ = any_ ? std::max(high_, at) : at;
    last_ = at;
    any_ = true;
  }
  // Divides the extent into cells; false where there is but one coordinate, or the cells are too
  // many to be counted.
  bool Divide() {
    if (steps_ == 0) return false;
    const double cells = std::round((high_ - low_) / (sum_ / static_cast<double>(steps_)));
    if (!(cells >= 1 && cells < static_cast<double>(kMaxGridSide))) return false;
    count_ = static_cast<std::int64_t>(cells) + 1;
    step_ = (high_ - low_) / cells;
    return true;
  }
  // The cell at `at`; nullopt where that is further off than rounding explains.
  [[nodiscard]] std::optional<std::int64_t> CellAt(double at) const {
    // Five decimals of a degree move a point by 1/55 of an arc second at most, and the ends of the
    // axis likewise.
    constexpr double kOff = 1.0 / 20;
    const double cell = (at - low_) / step_;
    if (std::abs(cell - std::round(cell)) > kOff) return std::nullopt;
    return static_cast<std::int64_t>(std::round(cell));
  }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] std::int64_t count() const { return count_; }

 private:
  void TakeStep(double step) {
    if (step * 1.5 < shortest_) {  // what was summed so far were steps over several cells
      shortest_ = step;
      sum_ = 0;
      steps_ = 0;
    }
    if (step >= 1.5 * shortest_) return;
    shortest_ = std::min(shortest_, step);
    sum_ += step;
    ++steps_;
  }

  bool any_ = false;
  double low_ = 0, high_ = 0, last_ = 0;
  double shortest_ = std::numeric_limits<double>::max();
  double sum_ = 0;
  std::int64_t steps_ = 0;
  double step_ = 0;
  std::int64_t count_ = 0;
};

Status FillCells(XyzReader& reader, const Axis& x, const Axis& y, std::vector<float>& cells) {
  std::vector<bool> filled(cells.size());
  std::size_t count = 0;
  while (true) {
    Result<std::optional<std::array<double, 3>>> next = reader.Next();
    if (!next) return std::move(next.error());
    if (!*next) break;
    const auto& [east, north, height] = **next;
    const std::optional<std::int64_t> column = x.CellAt(east);
    const std::optional<std::int64_t> row = y.CellAt(north);
    if (!column || !row) {
      return BadGrid("the list of points is no grid: the point in line " +
                     std::to_string(reader.line()) + " lies between the cells" + kScattered);
    }
    const auto cell = static_cast<std::size_t>((y.count() - 1 - *row) * x.count() + *column);
    if (filled[cell]) {
      return BadGrid("the list of points has the cell of line " + std::to_string(reader.line()) +
                     " twice; leave one height for each place (sort -u IN > OUT for lines that "
                     "are the same)");
    }
    filled[cell] = true;
    cells[cell] = static_cast<float>(height);
    ++count;
  }
  if (2 * count < cells.size()) {
    return BadGrid("the list of points is no grid: it has " + std::to_string(count) +
                   " points for the " + std::to_string(cells.size()) +
                   " cells that their spacing makes" + kScattered);
  }
  return Ok{};
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

Result<XyzGrid> ReadXyzList(const std::filesystem::path& path, std::int64_t max_cells) {
  Result<XyzReader> reader = XyzReader::Open(path);
  if (!reader) return std::move(reader.error());
  Axis x;
  Axis y;
  while (true) {
    Result<std::optional<std::array<double, 3>>> next = reader->Next();
    if (!next) return std::move(next.error());
    if (!*next) break;
    x.Take((**next)[0]);
    y.Take((**next)[1]);
  }
  if (!x.Divide() || !y.Divide()) {
    return BadGrid(std::string("the list of points is no grid of two rows and columns") +
                   kScattered);
  }
  XyzGrid list;
  list.order_is_stated = reader->order_is_stated();
  list.grid.columns = x.count();
  list.grid.rows = y.count();
  list.grid.geotransform = {x.low() - x.step() / 2,  x.step(), 0,
                            y.high() + y.step() / 2, 0,        -y.step()};
  if (Status fits = CheckGridSize(list.grid, max_cells); !fits) return std::move(fits.error());
  std::vector<float> cells(static_cast<std::size_t>(x.count() * y.count()),
                           std::numeric_limits<float>::quiet_NaN());
  Result<XyzReader> again = XyzReader::Open(path);
  if (!again) return std::move(again.error());
  if (Status filled = FillCells(*again, x, y, cells); !filled) return std::move(filled.error());
  list.grid.cells = GridCells::OfFloats(cells);
  return list;
}

}  // namespace farhorizon
