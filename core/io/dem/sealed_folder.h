#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace farhorizon {

/// A folder that GDAL sees in place of the real one: it has the files that are given and no other,
/// for reading alone. Whatever name a raster holds inside (.ige, .rrd, an absolute path that the
/// driver joins to the folder's), there is no such file.
/// Threads: safe; each has folders of its own. Lives until the raster is opened; handles that GDAL
/// has by then stay good.
class SealedFolder {
 public:
  /// files: all of one folder, under different names.
  explicit SealedFolder(const std::vector<std::filesystem::path>& files);
  ~SealedFolder();
  SealedFolder(const SealedFolder&) = delete;
  SealedFolder& operator=(const SealedFolder&) = delete;

  /// The name of `file` for GDAL.
  [[nodiscard]] std::string NameOf(const std::filesystem::path& file) const;

 private:
  std::string prefix_;  ///< with the number of this folder
  std::vector<std::string> names_;
};

}  // namespace farhorizon
