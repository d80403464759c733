#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "core/base/result.h"
#include "core/io/text_grid/text_grid.h"
#include "core/io/text_grid/text_words.h"

namespace farhorizon {

/// How the cells of a format are written.
struct BodyRules {
  std::string null_word = {};      ///< a cell that is just this word has no data; "" for none
  std::string nodata_number = {};  ///< what the header writes for no data, where that is a number
  /// As GridLimits has it.
  std::int64_t most_read = std::numeric_limits<std::int64_t>::max();
};

/// Errors: kResourceExhausted "raster-too-large" where `grid` says more than `max_cells`.
Status CheckGridSize(const TextGrid& grid, std::int64_t max_cells);

/// Reads the cells of `grid`, whose size is set: the word `first` and all of `words` after it; none
/// where they are more than `rules.most_read`.
/// Errors: kUnsupportedData "not-a-raster" for a word that is no number, with its line and column,
///   for commas that CommaRule refuses, and for lines that do not fit; "truncated".
Status ReadBody(TextWords& words, TextWord first, const BodyRules& rules, TextGrid& grid);

}  // namespace farhorizon
