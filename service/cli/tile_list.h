#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// The DEMs that words of a command line and a list name, in this order. A folder stands for the
/// files directly in it whose endings are those of DEMs, in the order of their names.
/// list: a file with a path a line, relative to where the program runs; empty lines and those that
///   begin with # are passed over; "-": standard input; empty: none.
/// Errors: kNotFound, kIo; kInvalidArgument where there is no DEM, or two have one name: their
///   artifacts would go to one folder.
Result<std::vector<std::string>> ReadTileList(const std::vector<std::string>& words,
                                              const std::string& list);

}  // namespace farhorizon
