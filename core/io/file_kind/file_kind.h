#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// The formats that are read, by what tells them.
enum class FileKind {
  kTiff,
  kDted,
  kUsgsDem,
  kArcGrid,       ///< Arc/Info ASCII grid
  kGrassGrid,     ///< GRASS ASCII raster
  kSurferText,    ///< Surfer 6 text grid, "DSAA"
  kSurferBinary,  ///< Surfer 6 binary grid, "DSBB"
  kSurfer7,       ///< Surfer 7 binary grid, "DSRB"
  kErdas,         ///< Erdas Imagine
  kHgt,           ///< SRTM HGT, known by its name
  kZippedHgt,     ///< the same in a zip archive: "N46E007.hgt.zip", "N46E007.SRTMGL1.hgt.zip"
  kXyz,           ///< lines of x, y and height
  kOther,         ///< none of these; it may be numbers that a file beside describes (ENVI, Esri)
};

/// What is known of a file before it is opened.
struct FileFacts {
  std::string_view beginning;  ///< its first 4096 bytes, or all where there are fewer
  std::int64_t bytes = 0;      ///< the size of the whole
  std::string_view filename;   ///< without folders
};

/// The bytes of a file that FileFacts wants.
inline constexpr std::size_t kBeginningBytes = 4096;

FileKind KindOfFile(const FileFacts& file);

/// Whether the cells of a file of this kind are text that core/io/text_grid reads.
bool IsTextGrid(FileKind kind);

/// Why a file that is of no kind that is read, or could not be opened as one, is not: what it is,
/// where that can be told, and what makes a DEM of it.
/// subject: what the message calls the file; complaint: what GDAL said of it, or "".
Error UnreadFile(const FileFacts& file, const std::string& subject, const std::string& complaint);

}  // namespace farhorizon
