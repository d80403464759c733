#include "core/io/text_grid/grass_grid.h"

#include <string>
#include <utility>

#include "core/io/text_grid/body_cells.h"
#include "core/io/text_grid/grid_header.h"

namespace farhorizon {

namespace {

// The length of a cell along an axis, from its two edges.
Result<double> CellAlong(const GridHeader& header, const std::string& low, const std::string& high,
                         std::int64_t cells) {
  Result<double> from = header.Number(low);
  if (!from) return std::move(from.error());
  Result<double> to = header.Number(high);
  if (!to) return std::move(to.error());
  if (*to <= *from) {
    return BadGrid("the grid's header has " + high + " " + header.Find(high)->text + " and " + low +
                   " " + header.Find(low)->text + ", which are the wrong way round");
  }
  return (*to - *from) / static_cast<double>(cells);
}

}  // namespace

Result<TextGrid> ReadGrassGrid(const std::filesystem::path& path, const GridLimits& limits) {
  Result<TextWords> words = TextWords::Open(path);
  if (!words) return std::move(words.error());
  Result<GridHeader> header = GridHeader::Read(
      *words, {"north:", "south:", "east:", "west:", "rows:", "cols:", "null:", "type:"});
  if (!header) return std::move(header.error());
  if (header->body().text.ends_with(':')) {
    return BadGrid("the grid's header has the word " + QuotedWord(header->body().text) + " in " +
                   PlaceOf(header->body()) +
                   ", which is not read; export the raster again with r.out.gdal");
  }
  Result<std::int64_t> columns = header->Count("cols:");
  if (!columns) return std::move(columns.error());
  Result<std::int64_t> rows = header->Count("rows:");
  if (!rows) return std::move(rows.error());
  TextGrid grid{.columns = *columns, .rows = *rows};
  Result<double> width = CellAlong(*header, "west:", "east:", *columns);
  if (!width) return std::move(width.error());
  Result<double> height = CellAlong(*header, "south:", "north:", *rows);
  if (!height) return std::move(height.error());
  grid.geotransform = {*header->Number("west:"), *width, 0, *header->Number("north:"), 0, -*height};
  if (Status fits = CheckGridSize(grid, limits.max_cells); !fits) return std::move(fits.error());
  BodyRules rules = {.null_word = "*", .most_read = limits.most_read};
  if (const TextWord* null = header->Find("null:")) {
    if (const std::optional<TextNumber> number = ParseNumber(null->text)) {
      grid.nodata = number->value;
    } else {
      rules.null_word = null->text;
    }
  }
  Status filled = ReadBody(*words, header->body(), rules, grid);
  if (!filled) return std::move(filled.error());
  return grid;
}

}  // namespace farhorizon
