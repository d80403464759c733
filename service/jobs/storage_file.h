#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

#include "core/base/result.h"
#include "core/io/unique_fd.h"

namespace farhorizon {

/// The Error of a failed call on the service's own files, from errno: kResourceExhausted "no-space"
/// where storage is full, else kIo "storage". Names what was being done and no path, because a
/// client may read it.
Error StorageError(const char* doing);

/// Opens a regular file for reading; follows no link. Errors: kNotFound, kIo.
Result<UniqueFd> OpenForReading(const std::filesystem::path& path);

/// Calls `take` with the bytes of an open file, piece by piece, until one call fails.
/// Errors: as StorageError(doing) where they cannot be read; those of `take`.
Status ForEachPiece(int fd, const char* doing,
                    const std::function<Status(std::string_view piece)>& take);

/// Makes the bytes of an open file durable. Ends the process where the disk fails
/// (EndAfterFailedSync). Errors: as StorageError, of a file system that is full or cannot sync.
Status SyncFile(int fd, const char* doing);
/// The same for the names in a folder.
Status SyncFolder(const std::filesystem::path& folder);

/// True for an error that the machine is the cause of, and no job: a disk that is full or fails, no
/// memory, no descriptor, no process. The work may succeed later as it is.
bool IsMachineFault(const Error& error);

/// What an ordinary user may still write on a file system.
struct DiskRoom {
  std::int64_t bytes = 0;
  std::int64_t files = 0;  ///< a great number where the file system has no such bound
};
/// The room on the file system of `path`.
Result<DiskRoom> RoomOf(const std::filesystem::path& path);
/// Bytes that an ordinary user may still write on the file system of `path`.
Result<std::int64_t> FreeBytes(const std::filesystem::path& path);

/// Succeeds if a file of the folder can be written, made durable and renamed. Leaves none, but
/// where the process is killed: its name starts with "probe". Errors: those of StorageError.
Status ProbeFolder(const std::filesystem::path& folder, const std::string& name = "");

}  // namespace farhorizon
