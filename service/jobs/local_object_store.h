#pragma once

#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Objects as read-only files `root`/ab/<sha256>, where ab are the first two digits. PutFile and
/// CopyTo copy bytes, so that no other process holds a descriptor of an object's own file;
/// temporary files are in `root`/temp.
/// Errors: kIo where the folder cannot be made.
Result<std::unique_ptr<ObjectStore>> OpenLocalObjectStore(const std::filesystem::path& root);

}  // namespace farhorizon
