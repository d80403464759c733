#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "service/jobs/fsck/check_store.h"

namespace farhorizon {

/// Copies the store of a data directory, whether its service runs or not, into the new folder
/// `target`: the database as of one moment, the file of keys, then every object that the database
/// names, each checked against its hash. Then the copy is checked and mended as by CheckStore: a
/// job that was removed while its objects were copied is told as a fault. The copy is a data
/// directory of its own; to restore, it takes the place of the other.
/// Errors: kIo where the folder has no store, or `target` is there and not empty.
Result<FsckSum> BackUpStore(const FsckOptions& source, const std::filesystem::path& target);

}  // namespace farhorizon
