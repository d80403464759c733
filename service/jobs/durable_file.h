#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "service/unique_fd.h"

namespace farhorizon {

/// The Error of a failed call on a file, from errno; "no-space" where the disk is full. Names the
/// deed, never the path: it may reach a client.
Error FileError(const char* doing);

/// Writes all of `bytes`. Errors: as FileError.
Status WriteAll(int fd, std::string_view bytes);

/// What was renamed, linked or removed in `directory` is on disk when it returns.
Status SyncDirectory(const std::filesystem::path& directory);

/// Opens a regular file for reading; follows no link. Errors: kNotFound, kIo.
Result<UniqueFd> OpenForReading(const std::filesystem::path& path);

/// Free bytes for an ordinary user on the file system of `path`.
Result<std::int64_t> FreeBytes(const std::filesystem::path& path);

}  // namespace farhorizon
