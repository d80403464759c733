#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/io/unique_fd.h"

namespace farhorizon {

/// A file of an AssetFolder.
struct Asset {
  std::filesystem::path path;
  std::int64_t bytes = 0;
  std::string sha256;
};

/// The files of a folder that the service hands out as they are: CesiumJS. They are listed once,
/// and only what is in the list can be asked for, so that no name leads out of the folder.
/// Threads: safe.
class AssetFolder {
 public:
  /// Lists and hashes all regular files below `folder`; links are passed over.
  /// Errors: kNotFound where it has no Cesium.js; kIo; kResourceExhausted where it has more than
  /// 10,000 files, so that it is another folder than was meant.
  /// Cost: reads all bytes once; 0.1 s for CesiumJS.
  static Result<AssetFolder> Read(const std::filesystem::path& folder);

  /// The file of that name, "Workers/decodeDraco.js"; nullptr where there is none.
  [[nodiscard]] const Asset* Find(const std::string& name) const;

  /// 16 hexadecimal digits of the hash of all names and bytes: in an address, it lets clients keep
  /// what they have for good.
  [[nodiscard]] const std::string& fingerprint() const { return fingerprint_; }
  [[nodiscard]] const std::map<std::string, Asset>& assets() const { return assets_; }

 private:
  std::map<std::string, Asset> assets_;
  std::string fingerprint_;
};

/// The file, open for reading. Errors: kIo where it is gone, is no file, or has changed its size
/// since it was listed.
Result<UniqueFd> OpenAsset(const Asset& asset);

/// The media type that a browser needs for a file of that name: MediaTypeOf, and scripts, styles,
/// WebAssembly and pictures.
std::string AssetMediaType(const std::string& name);

/// The folder that has CesiumJS where the configuration names none: `cesium` beside the program, or
/// share/farhorizon/cesium beside the program's bin; empty where neither is there.
std::filesystem::path InstalledCesium();

}  // namespace farhorizon
