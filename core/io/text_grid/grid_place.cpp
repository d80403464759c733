// Corner and centre, cellsize and dx, dy are two ways to say one thing. A header that uses both
// must mean the same by both: none of them is preferred in silence.
#include "core/io/text_grid/grid_place.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace farhorizon {

namespace {

// Two statements of one length agree within a millionth of a cell: writers round them.
bool Agree(double a, double b, double cell) { return std::abs(a - b) <= 1e-6 * cell; }

Result<double> CellSize(const GridHeader& header, const std::string& axis) {
  const std::string own = "d" + axis;
  if (!header.Has("cellsize") && !header.Has(own)) {
    return BadGrid("the grid's header has no cellsize (or dx and dy); it is missing, or misspelt");
  }
  const std::string key = header.Has(own) ? own : "cellsize";
  Result<double> size = header.Number(key);
  if (!size) return std::move(size.error());
  if (*size <= 0) {
    return BadGrid("the grid's header has " + QuotedWord(header.Find(key)->text) + " for " + key +
                   " in line " + std::to_string(header.Find(key)->line) +
                   "; cells must be larger than 0");
  }
  if (key == own && header.Has("cellsize")) {
    Result<double> common = header.Number("cellsize");
    if (!common) return std::move(common.error());
    if (!Agree(*common, *size, *size)) {
      return BadGrid("the grid's header says cellsize " + header.Find("cellsize")->text + " and " +
                     own + " " + header.Find(own)->text + "; leave the true one");
    }
  }
  return size;
}

// The western or southern edge of the grid.
Result<double> Edge(const GridHeader& header, const std::string& axis, double cell) {
  const std::string corner = axis + "llcorner";
  const std::string center = axis + "llcenter";
  if (!header.Has(corner) && !header.Has(center)) {
    return BadGrid("the grid's header has no " + corner + " (or " + center +
                   "); it is missing, or misspelt, and without it the place is not known");
  }
  std::optional<double> edge;
  if (header.Has(corner)) {
    Result<double> number = header.Number(corner);
    if (!number) return std::move(number.error());
    edge = *number;
  }
  if (header.Has(center)) {
    Result<double> number = header.Number(center);
    if (!number) return std::move(number.error());
    if (edge && !Agree(*edge, *number - cell / 2, cell)) {
      return BadGrid("the grid's header says " + corner + " " + header.Find(corner)->text +
                     " and " + center + " " + header.Find(center)->text +
                     ", which are not half a cell apart; leave the true one");
    }
    if (!edge) edge = *number - cell / 2;
  }
  return *edge;
}

}  // namespace

Result<std::array<double, 6>> LowerLeftPlace(const GridHeader& header, std::int64_t rows) {
  Result<double> width = CellSize(header, "x");
  if (!width) return std::move(width.error());
  Result<double> height = CellSize(header, "y");
  if (!height) return std::move(height.error());
  Result<double> west = Edge(header, "x", *width);
  if (!west) return std::move(west.error());
  Result<double> south = Edge(header, "y", *height);
  if (!south) return std::move(south.error());
  const double north = *south + static_cast<double>(rows) * *height;
  return std::array<double, 6>{*west, *width, 0, north, 0, -*height};
}

}  // namespace farhorizon
