// GDAL's driver takes words for 0, the commas of thousands for decimal ones, a missing corner for 0
// and the cells as they come, whatever their lines; it sees neither byte order marks nor Fortran's
// exponents. So the grid is read here. For well-formed files the values are GDAL's own: integers,
// or floats from the first cell with a point, a comma or an exponent on.
#include "core/io/text_grid/arc_grid.h"

#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/text_grid/body_cells.h"
#include "core/io/text_grid/grid_header.h"

namespace farhorizon {

namespace {

const std::vector<std::string_view> kKeys = {"ncols",     "nrows",        "xllcorner", "xllcenter",
                                             "yllcorner", "yllcenter",    "cellsize",  "dx",
                                             "dy",        "nodata_value", "nodata"};

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

const char* NoDataKey(const GridHeader& header) {
  return header.Has("nodata_value") ? "nodata_value" : "nodata";
}

Status ReadPlace(const GridHeader& header, TextGrid& grid) {
  Result<double> width = CellSize(header, "x");
  if (!width) return std::move(width.error());
  Result<double> height = CellSize(header, "y");
  if (!height) return std::move(height.error());
  Result<double> west = Edge(header, "x", *width);
  if (!west) return std::move(west.error());
  Result<double> south = Edge(header, "y", *height);
  if (!south) return std::move(south.error());
  const double north = *south + static_cast<double>(grid.rows) * *height;
  grid.geotransform = {*west, *width, 0, north, 0, -*height};
  return Ok{};
}

}  // namespace

Result<TextGrid> ReadArcGrid(const std::filesystem::path& path, std::int64_t max_cells) {
  Result<TextWords> words = TextWords::Open(path);
  if (!words) return std::move(words.error());
  Result<GridHeader> header = GridHeader::Read(*words, kKeys);
  if (!header) return std::move(header.error());
  const TextWord* nodata = header->Find(NoDataKey(*header));
  const TextWord& body = header->body();
  const bool cell = ParseNumber(body.text) || (nodata != nullptr && nodata->text == body.text);
  if (!cell && !body.text.empty() && std::isalpha(static_cast<unsigned char>(body.text[0])) != 0) {
    return BadGrid("the grid's header has the word " + QuotedWord(body.text) + " in " +
                   PlaceOf(body) +
                   ", which is none of ncols, nrows, xllcorner, yllcorner, xllcenter, yllcenter, "
                   "cellsize, dx, dy and NODATA_value; take that line out or correct it");
  }
  Result<std::int64_t> columns = header->Count("ncols");
  if (!columns) return std::move(columns.error());
  Result<std::int64_t> rows = header->Count("nrows");
  if (!rows) return std::move(rows.error());
  TextGrid grid{.columns = *columns, .rows = *rows};
  if (Status placed = ReadPlace(*header, grid); !placed) return std::move(placed.error());
  if (Status fits = CheckGridSize(grid, max_cells); !fits) return std::move(fits.error());
  BodyRules rules;
  if (nodata != nullptr) {
    if (ParseNumber(nodata->text)) {
      Result<double> number = header->NumberOrNan(NoDataKey(*header));
      if (!number) return std::move(number.error());
      grid.nodata = *number;
      rules.nodata_number = nodata->text;
    } else {
      rules.null_word = nodata->text;
    }
  }
  Status filled = ReadBody(*words, body, rules, grid);
  if (!filled) return std::move(filled.error());
  return grid;
}

}  // namespace farhorizon
