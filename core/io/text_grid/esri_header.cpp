// GDAL reads such a header leniently and without a word: what would be guessed from what is missing
// or misspelt is refused here, key by key, before it opens the raster.
#include "core/io/text_grid/esri_header.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/lower.h"
#include "core/io/text_grid/grid_header.h"
#include "core/io/text_grid/grid_place.h"

namespace farhorizon {

namespace {

// A count that may be left out, for `otherwise`; 0 is one, too.
Result<std::int64_t> CountOr(const GridHeader& header, const std::string& key,
                             std::int64_t otherwise) {
  const TextWord* word = header.Find(key);
  if (word == nullptr) return otherwise;
  return word->text == "0" ? Result<std::int64_t>(0) : header.Count(key);
}

Status CheckPlace(const GridHeader& header, std::int64_t rows) {
  const bool upper_left = header.Has("ulxmap") || header.Has("ulymap");
  // GDAL takes both for centres where one is.
  if ((header.Has("xllcenter") || header.Has("yllcenter")) &&
      (header.Has("xllcorner") || header.Has("yllcorner"))) {
    return BadGrid(
        "the raster's header has a corner and a centre (xllcorner, yllcenter); write corners "
        "alone, "
        "which lie half a cell to the west and south of the centres");
  }
  if (!upper_left) {
    Result<std::array<double, 6>> place = LowerLeftPlace(header, rows);
    return place ? Status(Ok{}) : Status(std::move(place.error()));
  }
  for (const char* key : {"ulxmap", "ulymap", "xdim", "ydim"}) {
    const bool is_size = key[1] == 'd';
    Result<double> number = header.Number(is_size && header.Has("cellsize") ? "cellsize" : key);
    if (!number) return std::move(number.error());
    if (is_size && *number <= 0) {
      return BadGrid("the raster's header has a cell that is not larger than 0 (" +
                     std::string(key) + ")");
    }
  }
  return Ok{};
}

Status CheckByteOrder(const GridHeader& header) {
  const TextWord* word = header.Find("byteorder");
  if (word == nullptr) {
    return BadGrid(
        "the raster's header does not say in which order the bytes of a number stand; add the "
        "line \"byteorder LSBFIRST\" (as PCs write) or \"byteorder MSBFIRST\"");
  }
  constexpr std::array<std::string_view, 4> kOrders = {"i", "lsbfirst", "m", "msbfirst"};
  if (std::ranges::find(kOrders, Lower(word->text)) != kOrders.end()) return Ok{};
  return BadGrid("the raster's header has " + QuotedWord(word->text) + " for byteorder in line " +
                 std::to_string(word->line) + ", which is neither LSBFIRST (I) nor MSBFIRST (M)");
}

// GDAL passes over the unit of heights.
Status CheckHeightUnit(const GridHeader& header) {
  const TextWord* word = header.Find("zunits");
  if (word == nullptr) return Ok{};
  constexpr std::array<std::string_view, 7> kMetres = {"m",      "meter", "meters", "metre",
                                                       "metres", "1",     "no"};
  if (std::ranges::find(kMetres, Lower(word->text)) != kMetres.end()) return Ok{};
  return BadGrid("the raster's header has heights in " + QuotedWord(word->text) +
                 " (zunits, line " + std::to_string(word->line) +
                 "), which is not read; take that line out, and state the unit with "
                 "--height-unit");
}

// That rows of `row_bytes` bytes follow one another, and fill the file.
Status CheckRows(const GridHeader& header, std::int64_t row_bytes) {
  for (const char* key : {"bandrowbytes", "totalrowbytes"}) {
    Result<std::int64_t> stated = CountOr(header, key, row_bytes);
    if (!stated) return std::move(stated.error());
    if (*stated != row_bytes && *stated != 0) {
      return BadGrid("the raster's header has rows of " + std::to_string(*stated) + " bytes (" +
                     key + "), but ncols and nbits make " + std::to_string(row_bytes) +
                     "; rows with gaps between them are not read");
    }
  }
  return Ok{};
}

}  // namespace

Status CheckEsriHeader(const std::filesystem::path& path, std::int64_t bytes) {
  Result<TextWords> words = TextWords::Open(path);
  if (!words) return std::move(words.error());
  Result<GridHeader> header = GridHeader::ReadLines(*words);
  if (!header) return std::move(header.error());
  Result<std::int64_t> columns = header->Count("ncols");
  if (!columns) return std::move(columns.error());
  Result<std::int64_t> rows = header->Count("nrows");
  if (!rows) return std::move(rows.error());
  Result<std::int64_t> bands = CountOr(*header, "nbands", 1);
  if (!bands) return std::move(bands.error());
  Result<std::int64_t> skipped = CountOr(*header, "skipbytes", 0);
  if (!skipped) return std::move(skipped.error());
  if (Status placed = CheckPlace(*header, *rows); !placed) return placed;
  if (Status metres = CheckHeightUnit(*header); !metres) return metres;
  if (*bands != 1) return Ok{};  // which is refused as such
  const std::int64_t cells = *columns * *rows;
  // Where nbits is missing (.flt has none), GDAL divides the bytes by the cells.
  const std::int64_t divided = bytes > *skipped ? (bytes - *skipped) / cells * 8 : 0;
  constexpr std::array<std::int64_t, 4> kSizes = {8, 16, 32, 64};
  const bool divides = std::ranges::find(kSizes, divided) != kSizes.end();
  Result<std::int64_t> bits = CountOr(*header, "nbits", divides ? divided : 32);
  if (!bits) return std::move(bits.error());
  if (*bits % 8 != 0 || *bits > 64) {
    return BadGrid("the raster's header has numbers of " + std::to_string(*bits) +
                   " bits (nbits), which are not read");
  }
  if (*bits > 8) {
    if (Status ordered = CheckByteOrder(*header); !ordered) return ordered;
  }
  if (Status fits = CheckRows(*header, *columns * (*bits / 8)); !fits) return fits;
  const std::int64_t size = *bits / 8;
  const std::int64_t wanted = cells < (std::int64_t{1} << 59U) ? *skipped + cells * size : -1;
  if (wanted == bytes) return Ok{};
  const std::string sizes = "the header says " + std::to_string(*columns) + " x " +
                            std::to_string(*rows) + " cells of " + std::to_string(size) +
                            " bytes, and the file has " + std::to_string(bytes) + " bytes" +
                            (wanted > 0 ? " instead of " + std::to_string(wanted) : "");
  if (wanted == -1 || bytes < wanted) {
    return Error{ErrorCode::kUnsupportedData,
                 "the raster is not complete: " + sizes + "; fetch or make the file again",
                 "truncated"};
  }
  return BadGrid("header and body of the raster disagree: " + sizes +
                 "; write the true numbers of columns, rows and bits into the header");
}

}  // namespace farhorizon
