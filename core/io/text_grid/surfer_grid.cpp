#include "core/io/text_grid/surfer_grid.h"

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "core/io/text_grid/body_cells.h"
#include "core/io/text_grid/grid_header.h"
#include "core/io/text_grid/text_number.h"
#include "core/io/text_grid/text_words.h"

namespace farhorizon {

namespace {

// What Surfer writes for a cell without data, as it writes it.
constexpr double kBlank = 1.70141e38;
constexpr std::array<std::string_view, 8> kHeader = {
    "the number of columns", "the number of rows", "the first x",      "the last x",
    "the first y",           "the last y",         "the least height", "the greatest height"};

Result<std::array<double, kHeader.size()>> ReadHeader(TextWords& words) {
  std::array<double, kHeader.size()> numbers{};
  for (std::size_t i = 0; i < kHeader.size(); ++i) {
    TextWord word;
    const std::string name(kHeader[i]);
    if (!words.Next(word)) return BadGrid("the grid ends before " + name);
    const std::optional<TextNumber> number = ParseNumber(word.text);
    if (!number || !std::isfinite(number->value) || number->comma == CommaUse::kEither) {
      return BadGrid("the grid has " + QuotedWord(word.text) + " in " + PlaceOf(word) + " for " +
                     name + ", which is no number");
    }
    numbers[i] = number->value;
  }
  return numbers;
}

bool IsSide(double cells) {
  return cells >= 2 && cells <= static_cast<double>(kMaxGridSide) && cells == std::floor(cells);
}

}  // namespace

Result<TextGrid> ReadSurferGrid(const std::filesystem::path& path, const GridLimits& limits) {
  Result<TextWords> words = TextWords::Open(path);
  if (!words) return std::move(words.error());
  TextWord word;
  words->Next(word);
  Result<std::array<double, kHeader.size()>> header = ReadHeader(*words);
  if (!header) return std::move(header.error());
  const auto& [columns, rows, west, east, south, north, least, greatest] = *header;
  if (!IsSide(columns) || !IsSide(rows) || !(east > west) || !(north > south)) {
    return BadGrid(
        "the grid's header makes no grid: it must have two columns and rows at least, and the last "
        "x and y must be greater than the first");
  }
  TextGrid grid{.columns = static_cast<std::int64_t>(columns),
                .rows = static_cast<std::int64_t>(rows)};
  const double width = (east - west) / (columns - 1);
  const double height = (north - south) / (rows - 1);
  grid.geotransform = {west - width / 2, width, 0, north + height / 2, 0, -height};
  if (Status fits = CheckGridSize(grid, limits.max_cells); !fits) return std::move(fits.error());
  words->Next(word);
  const BodyRules rules = {.nodata_number = "1.70141e38", .most_read = limits.most_read};
  Status filled = ReadBody(*words, std::move(word), rules, grid);
  if (!filled) return std::move(filled.error());
  if (grid.cells.is_float()) grid.nodata = kBlank;  // no whole number can be that
  grid.cells.FlipRows(static_cast<std::size_t>(grid.columns));
  return grid;
}

}  // namespace farhorizon
