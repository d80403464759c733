#pragma once

#include <cstdint>
#include <filesystem>

namespace farhorizon {

/// Room on the disk that the files below `folder` take, 64 KiB for each entry at least, followed no
/// further than to the first sum above `most`. Follows no link; what vanishes meanwhile, or
/// cannot be read, counts for nothing.
std::int64_t BytesIn(const std::filesystem::path& folder, std::int64_t most);

}  // namespace farhorizon
