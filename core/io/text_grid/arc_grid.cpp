// GDAL's driver takes words for 0, the commas of thousands for decimal ones, a missing corner for 0
// and the cells as they come, whatever their lines; it sees neither byte order marks nor Fortran's
// exponents. So the grid is read here. For well-formed files the values are GDAL's own: integers,
// or floats from the first cell with a point, a comma or an exponent on.
#include "core/io/text_grid/arc_grid.h"

#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/text_grid/body_cells.h"
#include "core/io/text_grid/grid_header.h"
#include "core/io/text_grid/grid_place.h"

namespace farhorizon {

namespace {

const std::vector<std::string_view> kKeys = {"ncols",     "nrows",        "xllcorner", "xllcenter",
                                             "yllcorner", "yllcenter",    "cellsize",  "dx",
                                             "dy",        "nodata_value", "nodata"};

const char* NoDataKey(const GridHeader& header) {
  return header.Has("nodata_value") ? "nodata_value" : "nodata";
}

}  // namespace

Result<TextGrid> ReadArcGrid(const std::filesystem::path& path, const GridLimits& limits) {
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
  Result<std::array<double, 6>> place = LowerLeftPlace(*header, *rows);
  if (!place) return std::move(place.error());
  grid.geotransform = *place;
  if (Status fits = CheckGridSize(grid, limits.max_cells); !fits) return std::move(fits.error());
  BodyRules rules{.most_read = limits.most_read};
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
