#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// Why PROJ might open something by name for `text`, a definition of a reference system in any of
/// the forms that PROJ reads: "names a grid file, which is not allowed". nullptr where it cannot.
///
/// It refuses more than PROJ would open: blanks, quotes, comments, escapes and brackets of every
/// kind that PROJ takes between a word and its value do not hide the word.
const char* NamedFileIn(std::string_view text);

/// Whether `bytes`, of a file that GDAL is to open, have such a definition somewhere: GDAL passes
/// them on to PROJ before this program sees them.
bool NamesFileSomewhere(std::string_view bytes);

/// The error for such a definition. whose: "the raster's".
Error SystemNamesFile(const std::string& whose);

}  // namespace farhorizon
