#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// The path of a file that another names by `uri`: percent-decoded, relative to `folder`, not above
/// it.
/// Errors: "bad-mesh-file" for an address with a scheme, an absolute path, one with "..", with a
///   backslash or an unprintable character. Whether the file exists is not looked at.
Result<std::filesystem::path> PathBeside(const std::filesystem::path& folder, std::string_view uri);

/// The bytes of a data: address; nullopt where `uri` is none, or none in base64.
std::optional<std::vector<std::uint8_t>> BytesOfDataUri(std::string_view uri);

}  // namespace farhorizon
