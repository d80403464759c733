#pragma once

#include <string>
#include <string_view>

#include "core/terrain/dem.h"

namespace farhorizon {

/// A DEM as it is drawn: a line a row, '.' a post without data, else a height; blank lines and the
/// blanks around a line do not count. A line without blanks inside is one digit a post.
/// Throws InternalError on anything else: a drawing is part of the test's own text.
Dem AsciiDem(std::string_view drawing);

/// The drawing of a DEM, heights in columns, ready to be put into a test.
std::string DrawAscii(const Dem& dem);

}  // namespace farhorizon
