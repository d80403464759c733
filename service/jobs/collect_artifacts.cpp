#include "service/jobs/collect_artifacts.h"

#include <set>
#include <string>

#include "core/io/file.h"
#include "core/io/manifest.h"

namespace farhorizon {

namespace {

constexpr const char* kManifest = "manifest.json";
constexpr std::uintmax_t kLargestManifest = 1U << 20U;
constexpr std::size_t kMostArtifacts = 1000;

Error InvalidArtifacts(const std::string& why) {
  return {ErrorCode::kUnsupportedData, "the worker's artifacts: " + why + "; the fault is ours",
          "worker-crashed"};
}

bool IsMediaType(const std::string& text) {
  return !text.empty() && text.size() <= 100 &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789/.+-") == std::string::npos;
}

}  // namespace

Result<std::vector<Artifact>> CollectArtifacts(const std::filesystem::path& directory,
                                               ObjectStore& objects) {
  Result<std::string> text = ReadFile(directory / kManifest, kLargestManifest);
  if (!text) return InvalidArtifacts(text.error().message);
  Result<std::vector<ManifestEntry>> entries = ReadManifest(*text);
  if (!entries) return InvalidArtifacts(entries.error().message);
  if (entries->size() > kMostArtifacts) return InvalidArtifacts("too many");
  std::set<std::string> names = {kManifest};
  std::vector<Artifact> artifacts;
  for (const ManifestEntry& entry : *entries) {
    if (!IsArtifactName(entry.name) || !IsMediaType(entry.media_type) ||
        !names.insert(entry.name).second) {
      return InvalidArtifacts("a name or media type that may not be");
    }
    Result<StoredObject> stored = objects.PutFile(directory / entry.name);
    if (!stored) {
      if (stored.error().code == ErrorCode::kNotFound) return InvalidArtifacts("a file is missing");
      return std::move(stored.error());
    }
    if (stored->sha256 != entry.sha256 || stored->bytes != static_cast<std::int64_t>(entry.bytes)) {
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
