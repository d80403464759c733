// The first pass finds the extent and the spacing, the second puts each height into its cell.
// Spacing: the mean of the steps that are about as long as the shortest, since rounding makes
// single steps too short or too long; then the extent is divided into whole cells.
#include "core/io/text_grid/xyz_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/io/text_grid/body_cells.h"
#include "core/io/text_grid/grid_header.h"
#include "core/io/text_grid/xyz_points.h"

namespace farhorizon {

namespace {

constexpr char kScattered[] =
    "; make a grid of its points first, with gdal_grid or pdal (writers.gdal)";

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

Status FillCells(XyzPoints& reader, const Axis& x, const Axis& y, std::vector<float>& cells) {
  std::vector<bool> filled(cells.size());
  std::size_t count = 0;
  while (true) {
    Result<std::optional<XyzPoint>> next = reader.Next();
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

Result<XyzGrid> ReadXyzList(const std::filesystem::path& path, const GridLimits& limits) {
  Result<XyzPoints> reader = XyzPoints::Open(path);
  if (!reader) return std::move(reader.error());
  Axis x;
  Axis y;
  while (true) {
    Result<std::optional<XyzPoint>> next = reader->Next();
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
  if (Status fits = CheckGridSize(list.grid, limits.max_cells); !fits) {
    return std::move(fits.error());
  }
  if (x.count() * y.count() > limits.most_read) return list;
  std::vector<float> cells(static_cast<std::size_t>(x.count() * y.count()),
                           std::numeric_limits<float>::quiet_NaN());
  Result<XyzPoints> again = XyzPoints::Open(path);
  if (!again) return std::move(again.error());
  if (Status filled = FillCells(*again, x, y, cells); !filled) return std::move(filled.error());
  list.grid.cells = GridCells::OfFloats(cells);
  return list;
}

}  // namespace farhorizon
