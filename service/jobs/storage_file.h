#pragma once

#include <cstdint>
#include <filesystem>

#include "core/base/result.h"
#include "core/io/unique_fd.h"

namespace farhorizon {

/// The Error of a failed call on the service's own files, from errno: kResourceExhausted "no-space"
/// where storage is full, else kIo "storage". Names what was being done and no path, because a
/// client may read it.
Error StorageError(const char* doing);

/// Opens a regular file for reading; follows no link. Errors: kNotFound, kIo.
Result<UniqueFd> OpenForReading(const std::filesystem::path& path);

/// Bytes that an ordinary user may still write on the file system of `path`.
Result<std::int64_t> FreeBytes(const std::filesystem::path& path);

}  // namespace farhorizon
