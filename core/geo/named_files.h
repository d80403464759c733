#pragma once

#include <string_view>

namespace farhorizon {

/// Why PROJ might open something by name for `text`, a definition of a reference system in any of
/// the forms that PROJ reads: "names a grid file, which is not allowed". nullptr where it cannot.
///
/// It refuses more than PROJ would open: blanks, quotes, comments, escapes and brackets of every
/// kind that PROJ takes between a word and its value do not hide the word.
const char* NamedFileIn(std::string_view text);

}  // namespace farhorizon
