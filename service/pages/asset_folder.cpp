#include "service/pages/asset_folder.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <utility>

#include "core/io/file.h"
#include "core/io/media_type.h"
#include "core/io/posix_file.h"
#include "core/io/sha256.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// Build/Cesium has some 400 files.
constexpr std::size_t kMostFiles = 10'000;
constexpr const char* kMain = "Cesium.js";

Error NoCesium(const fs::path& folder) {
  return {ErrorCode::kNotFound,
          folder.string() + " has no " + kMain +
              ": it is not the folder that service/pages/install-cesium makes",
          "no-such-file"};
}

}  // namespace

Result<AssetFolder> AssetFolder::Read(const fs::path& folder) {
  std::error_code failure;
  if (!fs::is_regular_file(folder / kMain, failure)) return NoCesium(folder);
  AssetFolder listed;
  fs::recursive_directory_iterator entries(folder, failure);
  for (; !failure && entries != fs::recursive_directory_iterator(); entries.increment(failure)) {
    if (entries->is_symlink() || !entries->is_regular_file()) continue;
    if (listed.assets_.size() == kMostFiles) {
      return Error{ErrorCode::kResourceExhausted,
                   folder.string() + " has more than " + std::to_string(kMostFiles) +
                       " files: is it a folder of CesiumJS?",
                   "resource-exhausted"};
    }
    Asset asset{entries->path(), static_cast<std::int64_t>(entries->file_size(failure)), {}};
    if (failure) break;
    Result<std::string> sha256 = Sha256OfFile(asset.path);
    if (!sha256) return std::move(sha256.error());
    asset.sha256 = *std::move(sha256);
    listed.assets_.emplace(asset.path.lexically_relative(folder).generic_string(), asset);
  }
  if (failure) return Error{ErrorCode::kIo, folder.string() + ": " + failure.message(), "io"};
  Sha256 all;
  for (const auto& [name, asset] : listed.assets_) {
    all.Add(name);
    all.Add(std::string_view("\0", 1));
    all.Add(asset.sha256);
  }
  listed.fingerprint_ = all.Finish().Hex().substr(0, 16);
  return listed;
}

const Asset* AssetFolder::Find(const std::string& name) const {
  const auto found = assets_.find(name);
  return found == assets_.end() ? nullptr : &found->second;
}

Result<UniqueFd> OpenAsset(const Asset& asset) {
  UniqueFd file(::open(asset.path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0) {
    return ErrorFromErrno(asset.path.string(), errno);
  }
  if (!S_ISREG(status.st_mode) || status.st_size != asset.bytes) {
    return Error{ErrorCode::kIo, asset.path.string() + " has changed since the start", "io"};
  }
  return file;
}

std::string AssetMediaType(const std::string& name) {
  static constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".wasm", "application/wasm"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".gif", "image/gif"},
      {".xml", "application/xml"},
      {".md", "text/plain; charset=utf-8"}};
  const std::string ending = fs::path(name).extension().string();
  for (const auto& [known, type] : kTypes) {
    if (ending == known) return std::string(type);
  }
  return MediaTypeOf(name);
}

fs::path InstalledCesium() {
  std::error_code failure;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  const fs::path home = program.parent_path();
  for (const fs::path& folder :
       {home / "cesium", home.parent_path() / "share" / "farhorizon" / "cesium"}) {
    if (!failure && fs::is_regular_file(folder / kMain, failure)) return folder;
    failure.clear();
  }
  return {};
}

}  // namespace farhorizon
