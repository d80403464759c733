#pragma once

#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Objects as files, `root`/ab/<sha256>, read-only. PutFile and Materialise copy, so that nobody
/// outside ever holds an object's own file; temporary files stand in `root`/temp.
/// Errors: kIo where the folder cannot be made.
Result<std::unique_ptr<ObjectStore>> OpenLocalObjectStore(const std::filesystem::path& root);

}  // namespace farhorizon
