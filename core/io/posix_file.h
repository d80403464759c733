#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// The Error of a POSIX call on a file that failed with the errno value `number`: "`doing`: " and
/// the system's text for `number`. kResourceExhausted where storage is full, else kIo; no kind.
Error ErrorFromErrno(const std::string& doing, int number);

/// Writes all of `bytes`. Returns false, with errno set, where that fails.
bool WriteAll(int fd, std::string_view bytes);

/// Reads at most `into.size()` bytes: their number, 0 at the end of the file, -1 with errno set.
/// A signal does not interrupt the call.
std::int64_t ReadSome(int fd, std::span<char> into);

/// Makes renames, links and removals in `directory` durable. Returns false, with errno set, where
/// the folder cannot be opened or the file system cannot sync it.
bool SyncDirectory(const std::filesystem::path& directory);

}  // namespace farhorizon
