#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Puts compressed copies beside each artifact for which they pay, once for all who fetch it: in
/// gzip where that saves a tenth of the bytes and a block of the disk, and in zstd where that saves
/// as much against gzip. Same bytes, same copies.
/// directory: for a copy while it is made. Requires: the objects of the artifacts are stored.
/// Errors: those of the store; kResourceExhausted "resource-exhausted" for want of memory.
/// Cost: that of compressor.h; no artifact of more than 32 MiB is tried in zstd, so 8 s at most.
Status AddCompressedCopies(std::vector<Artifact>& artifacts, ObjectStore& objects,
                           const std::filesystem::path& directory);

}  // namespace farhorizon
