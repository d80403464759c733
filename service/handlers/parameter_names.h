#pragma once

#include <string>
#include <string_view>

namespace farhorizon {

/// `text`, which names flags of the command line, as a client of the service reads it: each flag of
/// a build by its parameter, and a value after it as a query gives it. "give --nodata -9999 or
/// --crs" becomes "give nodata=-9999 or crs". Flags of other programs and of `serve` stay.
std::string WithParameterNames(std::string_view text);

}  // namespace farhorizon
