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
  /// A file and the name that it has for GDAL.
  struct Member {
    std::string name;
    std::filesystem::path path;
  };
  explicit SealedFolder(const std::vector<Member>& members);
  ~SealedFolder();
  SealedFolder(const SealedFolder&) = delete;
  SealedFolder& operator=(const SealedFolder&) = delete;

  /// The path of the member `name` for GDAL.
  [[nodiscard]] std::string PathOf(const std::string& name) const;

 private:
  std::string prefix_;  ///< with the number of this folder
  std::vector<std::string> names_;
};

}  // namespace farhorizon
