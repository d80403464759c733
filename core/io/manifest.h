#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// One artifact in manifest.json. sha256: lower-case hexadecimal, of its bytes.
struct ManifestEntry {
  std::string name;
  std::string media_type;
  std::uintmax_t bytes = 0;
  std::string sha256;
};

/// The text of manifest.json, with entries in the given order.
std::string WriteManifest(const std::vector<ManifestEntry>& entries);

/// The inverse of WriteManifest. Errors: kUnsupportedData, kind "bad-manifest".
Result<std::vector<ManifestEntry>> ReadManifest(const std::string& text);

}  // namespace farhorizon
