// The worker may have been taken over: everything that it left is looked at before it is opened,
// and nothing is opened in a way that waits. It has ended by now, and so has whatever it started,
// so that nothing changes between the look and the opening.
#include "service/jobs/collect_artifacts.h"

#include <dirent.h>
#include <memory>
#include <set>
#include <string>
#include <sys/stat.h>

#include "core/io/manifest.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

constexpr const char* kManifest = "manifest.json";
constexpr std::int64_t kLargestManifest = 1 << 20;

Error InvalidArtifacts(const std::string& why) {
  return {ErrorCode::kUnsupportedData, "the worker's artifacts: " + why + "; the fault is ours",
          "worker-crashed"};
}

bool IsMediaType(const std::string& text) {
  return !text.empty() && text.size() <= 100 &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789/.+-") == std::string::npos;
}

// The size of the file `path` as it lies there: a regular one, under no other name.
Result<std::int64_t> SizeOfOwnFile(const std::filesystem::path& path) {
  struct stat about {};
  if (::lstat(path.c_str(), &about) != 0) return InvalidArtifacts("a file is missing");
  if (!S_ISREG(about.st_mode))
    return InvalidArtifacts("a link, a folder or a device in their place");
  if (about.st_nlink != 1) return InvalidArtifacts("a file that has another name, too");
  return std::int64_t{about.st_size};
}

// Checks each thing in `directory`, as far as there may be artifacts.
Status CheckEntries(const std::filesystem::path& directory) {
  struct stat about {};
  if (::lstat(directory.c_str(), &about) != 0 || !S_ISDIR(about.st_mode)) {
    return InvalidArtifacts("their folder is gone");
  }
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(::opendir(directory.c_str()), ::closedir);
  if (!entries) return StorageError("list a worker's files");
  std::size_t count = 0;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): the stream is this function's own
  while (const dirent* entry = ::readdir(entries.get())) {
    const std::string name = entry->d_name;
    if (name == "." || name == "..") continue;
    if (++count > kMostArtifacts + 1) return InvalidArtifacts("too many files");
    Result<std::int64_t> size = SizeOfOwnFile(directory / name);
    if (!size) return std::move(size.error());
  }
  return Ok{};
}

Result<std::vector<ManifestEntry>> ReadOwnManifest(const std::filesystem::path& path) {
  Result<std::int64_t> size = SizeOfOwnFile(path);
  if (!size) return InvalidArtifacts("no manifest.json");
  if (*size > kLargestManifest) return InvalidArtifacts("a manifest.json of more than 1 MiB");
  Result<UniqueFd> file = OpenForReading(path);
  if (!file) return InvalidArtifacts("a manifest.json that cannot be read");
  std::string text;
  Status read = ForEachPiece(file->get(), "read a worker's manifest.json",
                             [&text](std::string_view piece) -> Status {
                               text += piece;
                               return Ok{};
                             });
  if (!read) return std::move(read.error());
  Result<std::vector<ManifestEntry>> entries = ReadManifest(text);
  if (!entries) return InvalidArtifacts(entries.error().message);
  if (entries->size() > kMostArtifacts) return InvalidArtifacts("too many");
  return entries;
}

}  // namespace

Result<std::vector<Artifact>> CollectArtifacts(const std::filesystem::path& directory,
                                               ObjectStore& objects) {
  if (Status sound = CheckEntries(directory); !sound) return std::move(sound.error());
  Result<std::vector<ManifestEntry>> entries = ReadOwnManifest(directory / kManifest);
  if (!entries) return std::move(entries.error());
  std::set<std::string> names = {kManifest};
  std::vector<Artifact> artifacts;
  for (const ManifestEntry& entry : *entries) {
    if (!IsArtifactName(entry.name) || !IsMediaType(entry.media_type) ||
        !names.insert(entry.name).second) {
      return InvalidArtifacts("a name or media type that may not be");
    }
    // Before the bytes are copied: a file with a hole may say any size.
    Result<std::int64_t> size = SizeOfOwnFile(directory / entry.name);
    if (!size) return std::move(size.error());
    if (static_cast<std::uintmax_t>(*size) != entry.bytes) {
      return InvalidArtifacts("a file is not what manifest.json says");
    }
    Result<StoredObject> stored = objects.PutFile(directory / entry.name);
    if (!stored) return std::move(stored.error());
    if (stored->sha256 != entry.sha256 || stored->bytes != *size) {
      return InvalidArtifacts("a file is not what manifest.json says");
    }
    artifacts.push_back({entry.name, entry.media_type, stored->bytes, stored->sha256});
  }
  Result<StoredObject> manifest = objects.PutFile(directory / kManifest);
  if (!manifest) return std::move(manifest.error());
  artifacts.push_back({kManifest, "application/json", manifest->bytes, manifest->sha256});
  return artifacts;
}

}  // namespace farhorizon
