#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// Lower-case hexadecimal SHA-256.
std::string Sha256Hex(std::string_view bytes);
/// Of a file, read in pieces. Errors: kNotFound, kIo.
Result<std::string> Sha256OfFile(const std::filesystem::path& path);

/// Errors: kNotFound, kIo; kResourceExhausted where the file has more than `max_bytes`.
Result<std::string> ReadFile(const std::filesystem::path& path,
                             std::uintmax_t max_bytes = std::uintmax_t{4} << 30U);
/// Writes beside the target, syncs and renames: a reader sees the old file or the new one.
/// Errors: kIo, kResourceExhausted (no space).
Status WriteFile(const std::filesystem::path& path, std::string_view bytes);

/// The media type an artifact of this name is served as: "model/gltf-binary" for ".glb".
std::string MediaTypeOf(const std::string& name);

/// One artifact in manifest.json.
struct ManifestEntry {
  std::string name;
  std::string media_type;
  std::uintmax_t bytes = 0;
  std::string sha256;
};
std::string WriteManifest(const std::vector<ManifestEntry>& entries);
/// Errors: kUnsupportedData.
Result<std::vector<ManifestEntry>> ReadManifest(const std::string& text);

}  // namespace farhorizon
