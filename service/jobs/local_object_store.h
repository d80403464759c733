#pragma once

#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Objects as read-only files `root`/ab/<sha256>, where ab are the first two digits; an incoming
/// one has a second name, incoming/<sha256>, and strays are stray/<sha256>. PutFile and CopyTo
/// copy bytes, so that no other process holds a descriptor of an object's own file; temporary files
/// are in `root`/temp. Files of other names are left alone.
/// Errors: kIo where the folders cannot be made.
Result<std::unique_ptr<ObjectStore>> OpenLocalObjectStore(const std::filesystem::path& root);

}  // namespace farhorizon
