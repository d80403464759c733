#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace farhorizon {

/// A world file: six lines that say where the cells of the raster beside it lie.
///
/// geotransform: GDAL's six coefficients, those of cell corners; nullopt where the file does not
/// have six numbers.
struct WorldFile {
  std::string name;
  std::optional<std::array<double, 6>> geotransform = {};
};

/// The world file of the raster at `path`, under one of the names that GIS programs give it: for
/// dem.tif dem.tfw, dem.tifw or dem.wld, in small or capital letters. nullopt where there is none.
///
/// Only numbers are read from it, at most 1 KiB, so that a file of unknown origin is safe.
std::optional<WorldFile> FindWorldFile(const std::filesystem::path& path);

/// The file beside `path` with another ending, ".prj", in small or capital letters; nullopt where
/// there is none.
std::optional<std::filesystem::path> FindBeside(const std::filesystem::path& path,
                                                const std::string& ending);

}  // namespace farhorizon
