#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// The path from the root, without dots and without a slash at its end. As it is where it is empty,
/// or relative while the process's folder is gone: to open it then says why.
std::filesystem::path AbsolutePath(const std::filesystem::path& path);

/// Lower-case hexadecimal SHA-256 of a file's bytes, read in pieces. Errors: kNotFound, kIo.
Result<std::string> Sha256OfFile(const std::filesystem::path& path);

/// All bytes of a regular file.
/// Errors: kNotFound, kIo; kResourceExhausted where the file has more than `max_bytes`.
Result<std::string> ReadFile(const std::filesystem::path& path,
                             std::uintmax_t max_bytes = std::uintmax_t{4} << 30U);

/// Writes a file beside the target, syncs and renames it: readers see the old file or the new one.
/// Errors: kNotFound no such folder; kIo; kResourceExhausted no space.
Status WriteFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace farhorizon
