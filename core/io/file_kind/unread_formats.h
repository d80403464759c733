#pragma once

#include <cstdint>
#include <string_view>

namespace farhorizon {

/// A format that is not read: what people call it, and what makes a DEM of it that is.
struct UnreadFormat {
  std::string_view name;    ///< "a netCDF file"
  std::string_view remedy;  ///< IN and OUT stand for the files
};

/// The format of a file that is none of those that are read, by its first bytes, or by the ending
/// of its name where it has no mark; nullptr where it cannot be told.
/// beginning: the first 4096 bytes, or all where there are fewer; bytes: the size of the whole.
const UnreadFormat* FindUnreadFormat(std::string_view beginning, std::int64_t bytes,
                                     std::string_view filename);

}  // namespace farhorizon
