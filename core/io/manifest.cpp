#include "core/io/manifest.h"

#include <utility>

#include <nlohmann/json.hpp>

namespace farhorizon {

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
