#include "core/io/files.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/io/posix_file.h"
#include "core/io/sha256.h"
#include "core/io/unique_fd.h"

namespace farhorizon {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 16U;

std::string Quoted(const std::filesystem::path& path) {
  std::string quoted(1, '"');
  return quoted.append(path.filename().string()).append(1, '"');
}

Error FromErrno(const std::string& what, const std::filesystem::path& path, int number) {
  Error error = ErrorFromErrno(what + " " + Quoted(path), number);
  if (number == ENOENT || number == ENOTDIR) error.code = ErrorCode::kNotFound;
  return error;
}

// Opens a regular file and shows its bytes to `take` piece by piece.
template <typename Take>
Status ReadPieces(const std::filesystem::path& path, Take take) {
  const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) return FromErrno("cannot open", path, errno);
  struct stat about {};
  if (::fstat(file.get(), &about) != 0) return FromErrno("cannot read", path, errno);
  if (!S_ISREG(about.st_mode)) {
    return Error{ErrorCode::kIo, Quoted(path) + " is not a regular file"};
  }
  std::vector<char> piece(kPieceBytes);
  for (;;) {
    const std::int64_t got = ReadSome(file.get(), piece);
    if (got < 0) return FromErrno("cannot read", path, errno);
    if (got == 0) return Done{};
    if (Status taken = take(std::string_view(piece.data(), static_cast<std::size_t>(got)));
        !taken) {
      return taken;
    }
  }
}

// Writes and syncs `file`, which is renamed only when this has succeeded.
Status FillAndSync(UniqueFd& file, const std::filesystem::path& path, std::string_view bytes) {
  if (!WriteAll(file.get(), bytes)) return FromErrno("cannot write", path, errno);
  if (::fchmod(file.get(), 0644) != 0) return FromErrno("cannot write", path, errno);
  if (::fsync(file.get()) != 0) return FromErrno("cannot sync", path, errno);
  if (!file.Close()) return FromErrno("cannot close", path, errno);
  return Done{};
}

}  // namespace

std::string Sha256Hex(std::string_view bytes) {
  Sha256 sum;
  sum.Add(bytes);
  return sum.Finish().Hex();
}

Result<std::string> Sha256OfFile(const std::filesystem::path& path) {
  Sha256 sum;
  Status read = ReadPieces(path, [&](std::string_view piece) -> Status {
    sum.Add(piece);
    return Done{};
  });
  if (!read) return std::move(read.error());
  return sum.Finish().Hex();
}

Result<std::string> ReadFile(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  std::string bytes;
  Status read = ReadPieces(path, [&](std::string_view piece) -> Status {
    if (piece.size() > max_bytes - bytes.size()) {
      return Error{ErrorCode::kResourceExhausted, Quoted(path) + " has more than the " +
                                                      std::to_string(max_bytes) + " bytes allowed"};
    }
    bytes += piece;
    return Done{};
  });
  if (!read) return std::move(read.error());
  return bytes;
}

Status WriteFile(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::string beside = (folder / path.filename()).string() + ".XXXXXX";
  UniqueFd file(::mkostemp(beside.data(), O_CLOEXEC));
  if (!file) return FromErrno("cannot create", path, errno);
  if (Status filled = FillAndSync(file, path, bytes); !filled) {
    ::unlink(beside.c_str());
    return filled;
  }
  if (::rename(beside.c_str(), path.c_str()) != 0) {
    const int number = errno;
    ::unlink(beside.c_str());
    return FromErrno("cannot put in place", path, number);
  }
  // The rename itself is durable only when the folder is synced; some file systems cannot.
  [[maybe_unused]] const bool synced = SyncDirectory(folder);
  return Done{};
}

std::string MediaTypeOf(const std::string& name) {
  static constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
      {".glb", "model/gltf-binary"},
      {".drc", "application/vnd.google.draco"},
      {".geojson", "application/geo+json"},
      {".json", "application/json"},
      {".fgb", "application/vnd.flatgeobuf"},
      {".gpkg", "application/geopackage+sqlite3"},
      {".svg", "image/svg+xml"},
      {".tif", "image/tiff; application=geotiff"},
      {".tiff", "image/tiff; application=geotiff"}};
  const std::string ending = std::filesystem::path(name).extension().string();
  for (const auto& [known, type] : kTypes) {
    if (ending == known) return std::string(type);
  }
  return "application/octet-stream";
}

std::string WriteManifest(const std::vector<ManifestEntry>& entries) {
  nlohmann::ordered_json artifacts = nlohmann::ordered_json::array();
  for (const ManifestEntry& entry : entries) {
    artifacts.push_back({{"name", entry.name},
                         {"media_type", entry.media_type},
                         {"bytes", entry.bytes},
                         {"sha256", entry.sha256}});
  }
  nlohmann::ordered_json manifest;
  manifest["artifacts"] = std::move(artifacts);
  return manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Result<std::vector<ManifestEntry>> ReadManifest(const std::string& text) {
  try {
    const nlohmann::json manifest = nlohmann::json::parse(text);
    std::vector<ManifestEntry> entries;
    for (const nlohmann::json& artifact : manifest.at("artifacts")) {
      entries.push_back(
          {artifact.at("name").get<std::string>(), artifact.at("media_type").get<std::string>(),
           artifact.at("bytes").get<std::uintmax_t>(), artifact.at("sha256").get<std::string>()});
    }
    return entries;
  } catch (const nlohmann::json::exception& failure) {
    return Error{ErrorCode::kUnsupportedData,
                 std::string("manifest.json cannot be read: ") + failure.what(), "bad-manifest"};
  }
}

}  // namespace farhorizon
